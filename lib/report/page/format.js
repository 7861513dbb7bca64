// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, and elements.
"use strict";

/** "1.83 GBq": three significant digits and a prefix. */
function activity(value_Bq) {
  if (value_Bq === null || !isFinite(value_Bq)) return "–";
  for (const [size, prefix] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]]) {
    if (Math.abs(value_Bq) >= 0.9995 * size) return `${digits(value_Bq / size, 3)}\u00a0${prefix}Bq`;
  }
  return `${digits(value_Bq, 3)}\u00a0Bq`;
}

/** So many significant digits, never in scientific notation for what a table holds. */
function digits(value, n) {
  if (value === 0) return "0";
  const decimals = Math.max(0, n - 1 - Math.floor(Math.log10(Math.abs(value))));
  return value.toFixed(Math.min(decimals, 12));
}

/** Fixed decimals; a dash where the value is not known. */
function fixed(value, decimals) {
  return value === null || value === undefined ? "–" : value.toFixed(decimals);
}

/** Whole number with thin spaces between thousands. */
function whole(value) {
  return value === null || value === undefined ? "–" : String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

function percent(share, decimals) {
  return share === null || share === undefined || !isFinite(share) ? "–" : `${(100 * share).toFixed(decimals)} %`;
}

function plural(n, word) {
  return `${n} ${word}${n === 1 ? "" : "s"}`;
}

/** An HTML element; children are elements or texts. */
function html(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Points [[x, y], ...] as a path; one decimal is a tenth of a pixel. */
function path(points) {
  return points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}

/** Index of the last element of an ascending list that is not above the value; -1: none. */
function lastNotAbove(list, value) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
}

/** Round steps for an axis: about n of them, 1, 2 or 5 times a power of ten. */
function niceSteps(low, high, n) {
  const rough = (high - low) / n, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(s => s * power).find(s => s >= rough * 0.999);
  const steps = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) steps.push(k * step);
  return {step, steps, decimals: Math.max(0, -Math.floor(Math.log10(step) + 1e-9))};
}

const tip = {
  show(event, text) {
    const box = document.getElementById("tip");
    box.textContent = text;
    box.style.display = "block";
    const x = event.clientX + 14, y = event.clientY + 14;
    box.style.left = `${Math.min(x, innerWidth - box.offsetWidth - 8)}px`;
    box.style.top = `${y + box.offsetHeight > innerHeight ? event.clientY - box.offsetHeight - 10 : y}px`;
  },
  hide() { document.getElementById("tip").style.display = "none"; },
};
