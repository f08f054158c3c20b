import { Vector3 } from 'three';
import { fileColours } from './files.js';

/** Light or dark: by the system until the reader chooses. Colours of the drawing are those of style.css. */
export class Theme {
  onChange = null;  // (colours)

  constructor() {
    document.getElementById('theme').addEventListener('click', () => this.toggle());
    this.system = matchMedia('(prefers-color-scheme: dark)');
    this.system.addEventListener('change', () => this.#apply(null));
    this.#apply(null);
  }

  get isDark() {
    return (this.chosen ?? (this.system.matches ? 'dark' : 'light')) === 'dark';
  }

  toggle() {
    this.#apply(this.isDark ? 'light' : 'dark');
  }

  #apply(chosen) {
    if (chosen) this.chosen = chosen;
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
    this.onChange?.(this.colours());
  }

  colours() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => parsed(style.getPropertyValue(`--${name}`).trim());
    return {
      files: Array.from({ length: fileColours }, (_, i) => colour(`file-${i}`)), red: colour('red'), tint: colour('tint'), edge: colour('edge'), curve: colour('curve'),
      selected: colour('selected'), partner: colour('partner'), held: colour('held'),
      heat: [0, 1, 2, 3, 4].map((i) => colour(`heat-${i}`)),
    };
  }
}

/** "#rrggbb" -> components in [0, 1]. */
function parsed(hex) {
  const number = parseInt(hex.slice(1), 16);
  return new Vector3(number >> 16 & 255, number >> 8 & 255, number & 255).divideScalar(255);
}
