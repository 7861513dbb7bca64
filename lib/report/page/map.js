// SPDX-License-Identifier: BSD-3-Clause
// The grid of the map: what the letters of a frame mean, and their picture.

/** One value per cell from a frame's text: share of the colour scale 0..1; NaN where there is no cell. */
function decodeLambda(text, map) {
  const values = new Float32Array(map.size[0] * map.size[1]);
  let at = 0;
  for (const [, letter, count] of text.matchAll(/([a-zA-Z-])(\d*)/g)) {
    const value = letter === "-" ? NaN : map.letters.indexOf(letter) / (map.letters.length - 1);
    const n = count === "" ? 1 : Number(count);
    values.fill(value, at, at + n);
    at += n;
  }
  return values;
}

/** 1 where a cell counts as searched, from the lengths of alternating runs. */
function decodeRuns(text, size) {
  const values = new Uint8Array(size);
  let at = 0;
  text.split(",").forEach((length, i) => {
    values.fill(i % 2, at, at + Number(length));
    at += Number(length);
  });
  return values;
}

function decodeFloats(base64) {
  return new Float32Array(Uint8Array.from(atob(base64), c => c.charCodeAt(0)).buffer);
}

/** lambda at a share of the colour scale, Bq. */
function lambdaAt(share, map) {
  return map.bottom_Bq * (map.top_Bq / map.bottom_Bq) ** share;
}

function shareOf(lambda_Bq, map) {
  const share = Math.log(lambda_Bq / map.bottom_Bq) / Math.log(map.top_Bq / map.bottom_Bq);
  return lambda_Bq > 0 ? Math.min(1, Math.max(0, share)) : 0;
}

/** The frame at a time: {values, searched, exact}; null before the first one. The last one is told cell by cell. */
function frameAt(map, t_s) {
  if (!map) return null;
  const index = lastNotAbove(map.frames.map(frame => frame.t_s), t_s);
  if (index < 0) return null;
  const frame = map.frames[index];
  if (!frame.values) {
    frame.searchedCells = decodeRuns(frame.searched, map.size[0] * map.size[1]);
    frame.exact = index === map.frames.length - 1 ? decodeFloats(map.lambda_Bq) : null;
    frame.values = frame.exact ? frame.exact.map(value => isNaN(value) ? NaN : shareOf(value, map)) :
        decodeLambda(frame.lambda, map);
  }
  return frame;
}

const COLOURS = Array.from({length: 256}, (_, i) => [...mapColour(i / 255), 255]);
const CLEAR = [0, 0, 0, 0];

/** One pixel per cell, north up. `colour(j)` gives [r, g, b, a]. */
function cellImage(map, colour) {
  const [nx, ny] = map.size;
  const image = html("canvas", {width: nx, height: ny});
  const pixels = new ImageData(nx, ny);
  for (let row = 0; row < ny; ++row) {
    for (let column = 0; column < nx; ++column) {
      pixels.data.set(colour(row * nx + column), 4 * ((ny - 1 - row) * nx + column));
    }
  }
  image.getContext("2d").putImageData(pixels, 0, 0);
  return image;
}

/** Diagonal lines, wherever `mask` (one pixel per cell) is opaque. */
function hatch(mask, width, height, ratio) {
  const canvas = html("canvas", {width, height});
  const context = canvas.getContext("2d");
  context.strokeStyle = "rgba(91, 98, 107, 0.55)";
  context.lineWidth = ratio;
  context.beginPath();
  for (let x = -height; x < width; x += 7 * ratio) {
    context.moveTo(x, height);
    context.lineTo(x + height, 0);
  }
  context.stroke();
  context.globalCompositeOperation = "destination-in";
  context.imageSmoothingEnabled = false;
  context.drawImage(mask, 0, 0, width, height);
  return canvas;
}

/** Paints the frame; hatched where the ground does not count as searched yet. */
function paintMap(canvas, map, frame, view, showHatch) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(view.width * ratio);
  canvas.height = Math.round(view.height * ratio);
  const part = (length, whole) => `${100 * length / whole}%`;  // of the drawing over it, also where print scales that
  Object.assign(canvas.style, {left: part(view.left, view.full_width), width: part(view.width, view.full_width),
                               top: part(view.top, view.full_height), height: part(view.height, view.full_height)});
  if (!frame) return;
  const [nx, ny] = map.size, cell_px = view.scale * map.cell_m * ratio;
  const left = (view.x(map.origin[0] * map.cell_m) - view.left) * ratio;
  const top = (view.y((map.origin[1] + ny) * map.cell_m) - view.top) * ratio;
  const context = canvas.getContext("2d");
  context.imageSmoothingEnabled = false;
  frame.picture ??= cellImage(map, j => isNaN(frame.values[j]) ? CLEAR : COLOURS[Math.round(255 * frame.values[j])]);
  context.drawImage(frame.picture, left, top, nx * cell_px, ny * cell_px);
  if (!showHatch) return;
  frame.open ??= cellImage(map, j => isNaN(frame.values[j]) || frame.searchedCells[j] ? CLEAR : COLOURS[0]);
  context.drawImage(hatch(frame.open, Math.round(nx * cell_px), Math.round(ny * cell_px), ratio), left, top);
}
