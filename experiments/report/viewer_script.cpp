#include "experiments/report/sections.h"

namespace relight::report {

// The state can be given after the page's address, for links and tests: #run=1&mode=wipe&stops=2&x=3&y=4.
const char* const viewer_script = R"js(
(() => {
  const root = document.getElementById('viewer');
  if (!root) return;
  const get = id => document.getElementById(id);
  const data = JSON.parse(get('viewer-data').textContent);
  const run = get('viewer-run'), mode = get('viewer-mode'), stops = get('viewer-stops');
  const panes = [...get('viewer-panes').children], images = data.images.map(() => null);
  let pair = null, place = null, cursor = null, flipped = false, drag = null;

  const half = h => {
    const e = h >> 10 & 31, f = h & 1023, s = h & 32768 ? -1 : 1;
    return e === 31 ? (f ? NaN : s * Infinity) : e ? s * 2 ** (e - 25) * (1024 + f) : s * 2 ** -24 * f;
  };
  const table = Float32Array.from({length: 65536}, (_, h) => half(h));

  // A PNG of twice the height: high bytes of the half floats above, low bytes below.
  async function load(i) {
    if (images[i]) return images[i];
    const {width: w, height: h, uri} = data.images[i], png = new Image();
    png.src = uri;
    await png.decode();
    const canvas = new OffscreenCanvas(w, 2 * h), context = canvas.getContext('2d', {willReadFrequently: true});
    context.drawImage(png, 0, 0);
    const bytes = context.getImageData(0, 0, w, 2 * h).data, values = new Float32Array(3 * w * h);
    for (let p = 0; p < w * h; ++p)
      for (let c = 0; c < 3; ++c) values[3 * p + c] = table[bytes[4 * p + c] << 8 | bytes[4 * (p + w * h) + c]];
    return images[i] = {w, h, values, label: data.images[i].label};
  }

  const srgb = v => 255 * Math.min(1, v <= 0.0031308 ? Math.max(0, 12.92 * v) : 1.055 * v ** (1 / 2.4) - 0.055);
  function picture(image, exposure) {
    const out = new ImageData(image.w, image.h);
    for (let p = 0; p < image.w * image.h; ++p) {
      const v = image.values.subarray(3 * p, 3 * p + 3), bad = !v.every(Number.isFinite);
      for (let c = 0; c < 3; ++c) out.data[4 * p + c] = bad ? (c === 1 ? 0 : 255) : srgb(exposure * v[c]);
      out.data[4 * p + 3] = 255;
    }
    return out;
  }
  function difference(a, b, exposure) {
    const out = new ImageData(a.w, a.h), n = data.colours.length;
    for (let p = 0; p < a.w * a.h; ++p) {
      let d = 0;
      for (let c = 0; c < 3; ++c) d += Math.abs(a.values[3 * p + c] - b.values[3 * p + c]) / 3;
      const bad = !Number.isFinite(d), colour = data.colours[Math.min(n - 1, Math.floor(n * exposure * d / 0.1))];
      for (let c = 0; c < 3; ++c) out.data[4 * p + c] = bad ? (c === 1 ? 0 : 255) : srgb(colour[c]);
      out.data[4 * p + 3] = 255;
    }
    return out;
  }

  const exposure = () => data.comparisons[run.value].exposure * 2 ** stops.value;
  let shown = [], key = '';
  function develop() {  // only when exposure, run or mode change
    const now = [run.value, stops.value, mode.value === 'difference'].join();
    if (now === key) return;
    key = now;
    const made = mode.value === 'difference' ? [difference(...pair, exposure())] : pair.map(i => picture(i, exposure()));
    shown = made.map(d => {
      const canvas = new OffscreenCanvas(d.width, d.height);
      canvas.getContext('2d').putImageData(d, 0, 0);
      return canvas;
    });
  }

  function paint(canvas, source, from, to) {
    const context = canvas.getContext('2d');
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.setTransform(place.scale, 0, 0, place.scale, place.x, place.y);
    context.drawImage(source, 0, 0);
    context.restore();
  }
  function draw() {
    if (!pair) return;
    develop();
    get('viewer-exposure').value = `x ${exposure().toPrecision(3)}`;
    const side = mode.value === 'side';
    panes[1].hidden = !side;
    for (const pane of panes) {
      pane.width = pane.clientWidth || 1;
      pane.height = Math.round(pane.width * pair[0].h / pair[0].w);
    }
    if (!place) place = {scale: panes[0].width / pair[0].w, x: 0, y: 0};
    const all = panes[0].width, cut = cursor ? cursor.x * place.scale + place.x : all / 2;
    if (side) panes.forEach((pane, i) => paint(pane, shown[i], 0, pane.width));
    else if (mode.value === 'wipe') paint(panes[0], shown[0], 0, cut), paint(panes[0], shown[1], cut, all);
    else paint(panes[0], shown[mode.value === 'flip' && flipped ? 1 : 0], 0, all);
    values();
  }
  function values() {
    const x = cursor && Math.floor(cursor.x), y = cursor && Math.floor(cursor.y), [a, b] = pair;
    if (!cursor || x < 0 || y < 0 || x >= a.w || y >= a.h) return void (get('viewer-values').textContent = '\u00a0');
    const at = i => [...i.values.subarray(3 * (y * a.w + x), 3 * (y * a.w + x) + 3)];
    const show = v => v.map(n => n.toPrecision(4)).join(' '), d = at(a).map((v, c) => v - at(b)[c]);
    get('viewer-values').textContent = `pixel ${x}, ${y}: ${a.label} ${show(at(a))}; ${b.label} ${show(at(b))}; difference ${show(d)}`;
  }

  async function choose() {
    const c = data.comparisons[run.value];
    pair = [await load(c.method), await load(c.reference)];
    draw();
  }
  const position = e => {
    const box = e.target.getBoundingClientRect();
    return {x: (e.clientX - box.left - place.x) / place.scale, y: (e.clientY - box.top - place.y) / place.scale};
  };
  for (const pane of panes) {
    pane.addEventListener('pointermove', e => {
      if (!place) return;
      if (drag) place.x += e.clientX - drag.x, place.y += e.clientY - drag.y, drag = {x: e.clientX, y: e.clientY, moved: true};
      cursor = position(e);
      draw();
    });
    pane.addEventListener('pointerdown', e => { drag = {x: e.clientX, y: e.clientY}; pane.setPointerCapture(e.pointerId); });
    pane.addEventListener('pointerup', () => {
      if (mode.value === 'flip' && drag && !drag.moved) flipped = !flipped;
      drag = null;
      draw();
    });
    pane.addEventListener('wheel', e => {
      e.preventDefault();
      const at = position(e), factor = 2 ** (-e.deltaY / 400);
      place.scale *= factor;
      place.x -= at.x * place.scale * (1 - 1 / factor), place.y -= at.y * place.scale * (1 - 1 / factor);
      draw();
    }, {passive: false});
  }
  document.addEventListener('keydown', e => { if (e.key === ' ' && mode.value === 'flip' && e.target === document.body) e.preventDefault(), flipped = !flipped, draw(); });
  data.comparisons.forEach((c, i) => run.add(new Option(c.label, i)));
  const state = new URLSearchParams(location.hash.slice(1));
  for (const [control, name] of [[run, 'run'], [mode, 'mode'], [stops, 'stops']]) if (state.has(name)) control.value = state.get(name);
  if (state.has('x')) cursor = {x: +state.get('x') + 0.5, y: +state.get('y') + 0.5};
  run.addEventListener('change', choose);
  for (const control of [mode, stops]) control.addEventListener('input', draw);
  get('viewer-fit').addEventListener('click', () => { place = null; draw(); });
  addEventListener('resize', () => { place = null; draw(); });
  choose().then(() => { root.dataset.ready = 'yes'; }, error => { root.dataset.ready = 'no'; get('viewer-values').textContent = `The viewer failed: ${error}`; });
})();
)js";

}  // namespace relight::report
