/** Numbers as people read them. */

const thin = '\u202f';

/** 1234567 -> "1 234 567" with narrow spaces. */
export function count(n) {
  return String(n).replace(/\B(?=(\d{3})+(?!\d))/g, thin);
}

/** Three digits: "0.0123", "12.3", "1.2e-7". */
export function short(x) {
  if (!Number.isFinite(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-4) return x.toExponential(1).replace('.0e', 'e').replace('e+', 'e').replace('-', '−').replace('e-', 'e−');
  return String(Number(x.toPrecision(3))).replace('-', '−');
}

/** A share as a percentage: 0.0123 -> "1.23 %". */
export function percent(share) {
  return `${short(100 * share)}${thin}%`;
}

/** A length in shares of the diagonal, in brackets in the units of the file. */
export function percentAndLength(share, diagonal) {
  return `${percent(share)} (${short(share * diagonal)})`;
}

export function plural(n, one, many) {
  return `${count(n)} ${n === 1 ? one : many}`;
}

/** 0.25 -> "0.25 s", 75 -> "1 min 15 s". */
export function duration(seconds) {
  if (seconds < 60) return `${short(seconds)} s`;
  return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
}
