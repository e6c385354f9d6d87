#include "experiments/report/sections.h"

namespace relight::report {

const char* const style_sheet = R"css(
:root { --ink:#1f2328; --soft:#656d76; --line:#d8dee4; --paper:#ffffff; --shade:#f6f8fa; --accent:#0a5f8a; }
* { box-sizing:border-box; }
body { margin:0 auto; max-width:1400px; padding:28px 32px 64px; color:var(--ink); background:var(--paper);
  font:15px/1.45 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
header { border-bottom:3px solid var(--accent); padding-bottom:10px; }
h1 { font-size:26px; margin:0 0 4px; } h2 { font-size:19px; margin:34px 0 10px; color:var(--accent); }
h3 { font-size:16px; margin:20px 0 8px; } h4 { font-size:14px; margin:0 0 6px; font-weight:600; }
header p, .note, small, figcaption { color:var(--soft); } header p { margin:0; }
.note { font-size:13px; max-width:105ch; }
table { border-collapse:collapse; width:100%; font-size:13.5px; }
section { overflow-x:auto; }
th, td { text-align:left; vertical-align:top; padding:7px 7px; border-bottom:1px solid var(--line); }
thead th { background:var(--shade); font-weight:600; font-size:13px; vertical-align:bottom; }
thead th.num { text-align:right; } tbody th { font-weight:600; }
td.num { text-align:right; font-variant-numeric:tabular-nums; white-space:nowrap; }
td small { display:block; font-size:11.5px; } td ul { margin:0; padding-left:18px; }
td.best b { color:#1a7f37; } tr.failed td, tr.failed th { background:#ffebe9; }
td.warn, ul.warn { background:#fff8c5; } ul.warn { padding:10px 10px 10px 28px; border:1px solid #eac54f; border-radius:6px; }
table.small { width:auto; font-size:13px; } table.small td { padding:3px 10px 3px 0; }
.grid { display:grid; grid-template-columns:repeat(var(--columns), minmax(0, 440px)); gap:12px; }
figure { margin:0; } figure img { width:100%; display:block; border-radius:3px; cursor:zoom-in; image-rendering:auto; }
figcaption { font-size:13px; padding-top:3px; }
.missing { aspect-ratio:4/3; display:flex; align-items:center; justify-content:center; padding:12px; text-align:center;
  background:#ffebe9; border-radius:3px; }
.bar { align-self:center; max-width:360px; padding:0 12px; } .bar p { font-size:12.5px; color:var(--soft); margin:4px 0 0; }
svg text { font-size:12px; fill:var(--ink); } .bar svg text { font-size:13px; }
.charts { display:flex; flex-wrap:wrap; gap:20px 36px; } .chart { flex:0 1 410px; }
rect.setup { fill:#8c959f; } rect.precompute { fill:#0a5f8a; } rect.relight { fill:#d1802b; }
pre { background:var(--shade); border:1px solid var(--line); border-radius:6px; padding:10px 12px; font-size:12.5px;
  white-space:pre-wrap; overflow-wrap:anywhere; }
#viewer .tools { display:flex; flex-wrap:wrap; gap:8px 14px; align-items:center; margin-bottom:8px; font-size:13.5px; }
#viewer input[type=range] { vertical-align:middle; width:220px; } #viewer output { font-variant-numeric:tabular-nums; }
#viewer-panes { display:flex; gap:8px; } #viewer-panes canvas { flex:1 1 0; min-width:0; touch-action:none; cursor:crosshair;
  background:var(--shade); border-radius:3px; } #viewer-panes canvas[hidden] { display:none; }
#viewer-values { font-variant-numeric:tabular-nums; max-width:none; }
#large { position:fixed; inset:0; display:none; align-items:center; justify-content:center; background:#000c; cursor:zoom-out; }
#large.shown { display:flex; } #large img { max-width:96vw; max-height:96vh; min-width:60vw; object-fit:contain; }
)css";

const char* const script = R"js(
const large = document.getElementById('large');
document.querySelectorAll('figure img').forEach(img => img.addEventListener('click', () => {
  large.replaceChildren(img.cloneNode()); large.classList.add('shown');
}));
large.addEventListener('click', () => large.classList.remove('shown'));
document.addEventListener('keydown', e => { if (e.key === 'Escape') large.classList.remove('shown'); });
)js";

}  // namespace relight::report
