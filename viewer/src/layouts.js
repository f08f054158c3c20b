/** What each layout draws: views of the stage. A rect is in shares of the canvas, from its top left. */

const whole = { x: 0, y: 0, width: 1, height: 1 };
const part = (from, to) => ({ x: from, y: 0, width: to - from, height: 1 });
const rows = [{ x: 0, y: 0, width: 1, height: 0.5 }, { x: 0, y: 0.5, width: 1, height: 0.5 }];

/** state: { layout, blend, divider }; tall: the canvas is, as on a phone. Each view: where (rect), what of it (clip), when (t; frame: the recorded one). */
export function viewsOf({ layout, blend, divider }, tall = false) {
  switch (layout) {
    case 'pair':
      if (tall) return rows.map((rect, t) => ({ rect, clip: rect, t }));
      return [{ rect: part(0, 0.5), clip: part(0, 0.5), t: 0 }, { rect: part(0.5, 1), clip: part(0.5, 1), t: 1 }];
    case 'wipe':
      return [{ rect: whole, clip: part(0, divider), t: 0 }, { rect: whole, clip: part(divider, 1), t: 1 }];
    case 'blend':
      return [{ rect: whole, clip: whole, t: blend }];
    case 'replay':
      return [{ rect: whole, clip: whole, t: 0, frame: true }];
    default:  // one surface only
      return [{ rect: whole, clip: whole, t: 0 }];
  }
}

/** How red the conflicts of each state are in a view, and how visible its curves, which hold for that state alone. */
export function strengthsOf({ t, frame }, { colouring, curves }) {
  const red = colouring === 'displacement' ? 0 : 1;
  const held = colouring === 'conflicts' ? 1 : 0;
  if (frame) return { before: 0, after: 0, frame: red, held, curvesBefore: 0, curvesAfter: 0 };
  const shown = curves ? 1 : 0;
  return {
    before: red * (1 - t),
    after: red * t,
    frame: 0,
    held,
    curvesBefore: shown * Math.max(0, 1 - 4 * t),
    curvesAfter: shown * Math.max(0, 4 * t - 3),
  };
}
