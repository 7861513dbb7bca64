// SPDX-License-Identifier: BSD-3-Clause
// Curves over time of all configurations: the median of the runs as a line, from quartile to quartile as a band.

/** Ticks at 1, 2 and 5 times powers of ten, where there is room for them. */
function decades(low, high) {
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; ++power) {
    for (const step of [1, 2, 5]) {
      const value = step * 10 ** power;
      if (value >= 0.999 * low && value <= 1.001 * high) ticks.push([value, digits(value, 1)]);
    }
  }
  return ticks;
}

/** What happens, happens early: time is drawn logarithmically. */
function timeScale(campaign, from_px, to_px) {
  const low = Math.max(1, campaign.horizon_s / 100);
  return Object.assign(logScale(low, campaign.horizon_s, from_px, to_px), {low, ticks: decades(low, campaign.horizon_s)});
}

function dashOf(index) {
  return index < OKABE_ITO.length ? "none" : "6 3";
}

function drawBand(curve, colour, x, y, low_s) {
  const there = [], back = [];
  curve.lower.forEach((value, i) => {
    if (i + 1 < low_s || value === null || curve.upper[i] === null) return;
    there.push([x(i + 1), y(curve.upper[i])]);
    back.unshift([x(i + 1), y(value)]);
  });
  return svg("path", {d: path([...there, ...back]) + "Z", fill: colour, opacity: 0.13});
}

/** options: key of the teams' curves, y (a scale), name, unit, decimals, level {y, text} */
function drawQuartiles(id, campaign, options) {
  const box = document.getElementById(id), width = Math.max(320, box.clientWidth), height = 236;
  const left = 36, right = width - 130, top = 14, bottom = height - 34;
  const x = timeScale(campaign, left, right), y = options.y(bottom, top);
  const root = svg("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": options.name});
  drawAxes(root, {...options, counts: options.unit === ""}, x, y, {left, right, top, bottom});
  root.append(svg("text", {x: (left + right) / 2, y: bottom + 31, "text-anchor": "middle", class: "axis"}, "time, s, logarithmic"));
  const lines = campaign.teams.map((team, i) => {
    const seconds = team[options.key].median.map((_, k) => k + 1).filter(t_s => t_s >= x.low);
    return {name: team.name, colour: categoryColour(i), width: 2, dash: dashOf(i), t: seconds,
            y: seconds.map(t_s => team[options.key].median[t_s - 1])};
  });
  campaign.teams.forEach((team, i) => {
    root.append(svg("g", {class: `fades team-${i}`}, drawBand(team[options.key], categoryColour(i), x, y, x.low)));
  });
  lines.forEach((line, i) => root.append(svg("g", {class: `fades team-${i}`}, drawLine(line, x, y))));
  drawLabels(root, lines, y, right + 6, [top, bottom]);
  const time = event => {
    const share = (event.clientX - root.getBoundingClientRect().left - left) / (right - left);
    return x.low * (campaign.horizon_s / x.low) ** Math.min(1, Math.max(0, share));
  };
  root.addEventListener("pointerleave", tip.hide);
  root.addEventListener("pointermove", event => tip.show(event, quartileTip(campaign, options, Math.round(time(event)))));
  box.replaceChildren(root);
}

function quartileTip(campaign, options, t_s) {
  const rows = campaign.teams.map(team => {
    const curve = team[options.key], value = list => fixed(list[t_s - 1], options.decimals);
    return `${team.name}: ${value(curve.median)} (${value(curve.lower)} to ${value(curve.upper)}) ${options.unit}`;
  });
  return [`${t_s} s: median (quartiles)`, ...rows].join("\n");
}
