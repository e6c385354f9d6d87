#include "experiments/experiment_page/page_parts.h"

namespace relight::page {

// The state can be given after the page's address, for links: #error=indirect&cost=memory&off=a,b.
const char* const plot_script = R"js(
(() => {
  const data = JSON.parse(document.getElementById('plot-data').textContent);
  const errorChoice = document.getElementById('error-choice'), costChoice = document.getElementById('cost-choice');
  const tip = document.getElementById('tip'), legend = document.getElementById('legend');
  const colours = ['#0a5f8a', '#c26a15', '#1a7f37', '#8e3b8a', '#b3261e', '#5c6f00', '#3d4fb8', '#7a5a3a'];
  const W = 600, H = 400, left = 62, right = 14, top = 12, bottom = 46, off = new Set();
  const colour = method => colours[data.methods.indexOf(method) % colours.length];

  function make(name, attributes, ...children) {
    const e = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    e.append(...children);
    return e;
  }
  // A shape a method, for eyes that do not tell the colours apart.
  function mark(method, x, y, r) {
    const shapes = [[], [-1, -1, 1, -1, 1, 1, -1, 1], [0, -1.3, 1.2, 0.9, -1.2, 0.9], [0, -1.4, 1.4, 0, 0, 1.4, -1.4, 0], [0, 1.3, 1.2, -0.9, -1.2, -0.9]];
    const shape = shapes[data.methods.indexOf(method) % shapes.length], fill = colour(method);
    if (!shape.length) return make('circle', {cx: x, cy: y, r, fill});
    return make('polygon', {points: shape.map((v, i) => (i % 2 ? y : x) + 0.9 * r * v).join(' '), fill});
  }
  const digits = v => v === 0 ? '0' : String(+v.toPrecision(3));
  const costText = {
    relight: v => v < 1000 ? `${digits(v)} ms` : `${digits(v / 1000)} s`,
    memory: v => `${digits(v / 1e6)} MB`,
    precompute: v => v < 1 ? `${digits(1000 * v)} ms` : `${digits(v)} s`,
  };
  const errorText = v => `${digits(100 * v)} %`;

  // Logarithmic; what is below 1e-5 of the largest, zero among it, is drawn on the border.
  function scale(values, from, to) {
    let all = values.filter(v => v > 0);
    if (!all.length) all = [1];
    const max = Math.max(...all), small = max * 1e-5;
    let lo = Math.log10(Math.min(...all.filter(v => v >= small))), hi = Math.log10(max);
    const pad = Math.max(0.06 * (hi - lo), 0.05);
    lo -= pad, hi += pad;
    const at = v => from + (to - from) * (Math.max(v > 0 ? Math.log10(v) : lo, lo) - lo) / (hi - lo);
    const ticks = [], steps = hi - lo > 2.2 ? [1] : hi - lo > 0.7 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
    for (let d = Math.floor(lo); d <= hi; ++d) for (const s of steps) {
      const t = d + Math.log10(s);
      if (t >= lo && t <= hi) ticks.push(s * 10 ** d);
    }
    return {at, ticks, border: v => !(v > 0) || Math.log10(v) < lo};
  }
  function describe(p, error, cost) {
    const [e, elow, ehigh] = p.errors[error], [c, clow, chigh] = p.costs[cost], t = costText[cost];
    return `${p.method} ${p.label}\n${errorText(e)} (${errorText(elow)} to ${errorText(ehigh)})\n${t(c)}` +
      (clow < chigh ? ` (${t(clow)} to ${t(chigh)})` : '');
  }
  function showTip(text, target) {
    const box = target.getBoundingClientRect();
    tip.textContent = text;
    tip.hidden = false;
    tip.style.left = `${Math.max(8, Math.min(box.x + scrollX + 14, scrollX + innerWidth - tip.offsetWidth - 16))}px`;
    tip.style.top = `${box.y + scrollY + 16}px`;
  }

  function plot(element) {
    const group = data.groups[element.dataset.group], error = errorChoice.value, cost = costChoice.value;
    const good = p => !p.failed && p.errors[error] && p.costs[cost];
    const shown = group.points.filter(p => good(p) && !off.has(p.method));
    if (!shown.length) return void element.replaceChildren('No run to draw for this choice.');
    const floor = group.floors[error];
    const x = scale(shown.flatMap(p => p.costs[cost]), left, W - right);
    const y = scale(shown.flatMap(p => p.errors[error]).concat(floor ? [floor[0]] : []), H - bottom, top);
    const svg = make('svg', {viewBox: `0 0 ${W} ${H}`, role: 'img', 'aria-label': `${group.title}: ${error} against ${cost}`});
    const grid = make('g', {class: 'grid'});
    for (const t of x.ticks) grid.append(make('line', {x1: x.at(t), x2: x.at(t), y1: top, y2: H - bottom}), make('text', {x: x.at(t), y: H - bottom + 16, 'text-anchor': 'middle'}, costText[cost](t)));
    for (const t of y.ticks) grid.append(make('line', {x1: left, x2: W - right, y1: y.at(t), y2: y.at(t)}), make('text', {x: left - 6, y: y.at(t) + 4, 'text-anchor': 'end'}, errorText(t)));
    svg.append(grid, make('rect', {class: 'frame', x: left, y: top, width: W - left - right, height: H - top - bottom}));
    svg.append(make('text', {class: 'axis', x: (left + W - right) / 2, y: H - 8, 'text-anchor': 'middle'}, costChoice.selectedOptions[0].text));
    svg.append(make('text', {class: 'axis', transform: `translate(13 ${(top + H - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle'}, errorChoice.selectedOptions[0].text));
    if (floor) svg.append(make('line', {class: 'floor', x1: left, x2: W - right, y1: y.at(floor[0]), y2: y.at(floor[0])}),
      make('text', {x: W - right - 4, y: y.at(floor[0]) - 5, 'text-anchor': 'end'}, `noise floor ${errorText(floor[0])}`));
    const fronts = group.fronts[`${error} ${cost}`], onFront = new Set(Object.values(fronts.methods).flat());
    for (const [method, front] of Object.entries(fronts.methods)) {
      if (off.has(method) || !front.length) continue;
      const points = front.map(i => group.points[i]);
      let path = '';
      points.forEach((p, i) => { path += i ? `H${x.at(p.costs[cost][0])}V${y.at(p.errors[error][0])}` : `M${x.at(p.costs[cost][0])} ${y.at(p.errors[error][0])}`; });
      svg.append(make('path', {class: 'front', d: path + `H${W - right}`, stroke: colour(method), 'data-method': method}));
    }
    group.points.forEach((p, i) => {
      if (!good(p) || off.has(p.method)) return;
      const [e, elow, ehigh] = p.errors[error], [c, clow, chigh] = p.costs[cost], px = x.at(c), py = y.at(e), stroke = colour(p.method);
      const g = make('g', {class: `point${onFront.has(i) ? '' : ' faded'}`, 'data-method': p.method, 'data-label': p.label});
      g.append(make('g', {class: 'bar'}, make('line', {x1: x.at(clow), x2: x.at(chigh), y1: py, y2: py, stroke}), make('line', {x1: px, x2: px, y1: y.at(elow), y2: y.at(ehigh), stroke})));
      g.append(mark(p.method, px, py, 5));
      if (x.border(c)) g.append(make('text', {x: px + 9, y: py + 4}, costText[cost](c)));
      if (fronts.all.includes(i)) g.append(make('circle', {class: 'ring', cx: px, cy: py, r: 7.5}));
      g.addEventListener('pointerenter', () => showTip(describe(p, error, cost), g));
      g.addEventListener('pointerleave', () => { tip.hidden = true; });
      svg.append(p.link ? make('a', {href: p.link}, g) : g);
    });
    element.replaceChildren(svg);
  }
  function draw() {
    tip.hidden = true;
    document.querySelectorAll('.plot').forEach(plot);
    for (const e of document.querySelectorAll('.choice')) e.hidden = e.dataset.error !== errorChoice.value || e.dataset.cost !== costChoice.value;
    for (const b of legend.children) b.setAttribute('aria-pressed', !off.has(b.dataset.method));
    document.body.dataset.drawn = `${errorChoice.value} ${costChoice.value}`;
  }
  function toggle(method) {
    if (!off.delete(method)) off.add(method);
    draw();
  }
  for (const method of data.methods) {
    const button = document.createElement('button');
    button.dataset.method = method;
    button.append(make('svg', {viewBox: '0 0 14 14'}, mark(method, 7, 7, 5)), method);
    button.addEventListener('click', () => toggle(method));
    legend.append(button);
  }
  const state = new URLSearchParams(location.hash.slice(1));
  for (const [control, name] of [[errorChoice, 'error'], [costChoice, 'cost']]) {
    if (state.has(name)) control.value = state.get(name);
    control.addEventListener('change', draw);
  }
  for (const method of (state.get('off') ?? '').split(',')) if (data.methods.includes(method)) off.add(method);
  draw();
})();
)js";

}  // namespace relight::page
