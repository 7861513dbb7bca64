// SPDX-License-Identifier: BSD-3-Clause
// Colours. Drones and sources: after Okabe and Ito's set, told apart with any colour vision, darkened for white paper. The map: even steps of lightness
// in OKLab (Ottosson 2020) from near white, through orange and red, to a dark violet, so that equal ratios of lambda
// look equally far apart, also in grey.

const OKABE_ITO = ["#0072b2", "#d55e00", "#009e73", "#b0568a", "#3d9bd6", "#8f6b00", "#4d4d4d"];

function categoryColour(index) {
  return OKABE_ITO[index % OKABE_ITO.length];
}

/** OKLab lightness, chroma and hue (degrees) as [r, g, b] of 0..255. */
function oklch(lightness, chroma, hue_deg) {
  const a = chroma * Math.cos(hue_deg * Math.PI / 180), b = chroma * Math.sin(hue_deg * Math.PI / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                  -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s];
  const gamma = c => c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  return linear.map(c => Math.round(255 * Math.min(1, Math.max(0, gamma(Math.min(1, Math.max(0, c)))))));
}

/** Colour of the map's scale, 0 at its bottom, 1 at its top. */
function mapColour(value) {
  const v = Math.min(1, Math.max(0, value));
  return oklch(0.985 - 0.765 * v, 0.012 + 0.62 * v * (1 - v) * (0.75 - 0.2 * v) + 0.09 * v * v, 95 - 165 * v ** 1.15);
}
