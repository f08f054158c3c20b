/** What each key does; see help.js for the words. more: { key: action } of a page that has more. */
export function listenToKeys(viewer, { more = {}, signal } = {}) {
  const help = document.getElementById('help');
  const actions = {
    1: () => viewer.setLayout('pair'),
    2: () => viewer.setLayout('wipe'),
    3: () => viewer.setLayout('blend'),
    4: () => viewer.setLayout('replay'),
    c: () => viewer.setColouring('conflicts'),
    m: () => viewer.setColouring('texture'),
    d: () => viewer.setColouring('displacement'),
    r: () => viewer.changeRange(),
    e: () => viewer.toggle('edges'),
    x: () => viewer.toggle('curves'),
    n: () => viewer.pickNext(1),
    p: () => viewer.pickNext(-1),
    f: () => viewer.stage.showAll(),
    u: () => viewer.stage.turnUp(),
    s: () => viewer.save(),
    t: () => viewer.theme.toggle(),
    '?': () => help.showModal(),
    ' ': () => viewer.play(),
    Escape: () => viewer.pick(-1),
    ArrowLeft: () => viewer.slide(-1),
    ArrowRight: () => viewer.slide(1),
    ...more,
  };
  addEventListener('keydown', (event) => {
    const isTyping = event.target.closest?.('select, dialog, input:not([type=range])') || (event.target.type === 'range' && event.key.startsWith('Arrow'));
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping) return;
    if (event.key === ' ' && event.target.tagName === 'BUTTON') return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }, { signal });
}
