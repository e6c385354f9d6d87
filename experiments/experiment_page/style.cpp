#include "experiments/experiment_page/page_parts.h"

namespace relight::page {

// On top of the style sheet of a comparison's page.
const char* const style_sheet = R"css(
#controls { position:sticky; top:0; z-index:2; background:var(--paper); padding:8px 0; border-bottom:1px solid var(--line);
  display:flex; flex-wrap:wrap; gap:8px 18px; align-items:center; font-size:13.5px; }
#legend button { font:inherit; border:1px solid var(--line); border-radius:6px; background:var(--shade); padding:3px 9px;
  margin-right:6px; cursor:pointer; } #legend button[aria-pressed=false] { opacity:.45; text-decoration:line-through; }
#legend svg { width:14px; height:14px; vertical-align:-2px; margin-right:5px; }
.beside { display:flex; flex-wrap:wrap; gap:12px 30px; align-items:flex-start; }
.plot { flex:0 1 600px; min-width:420px; } .plot svg { width:100%; display:block; }
.limits { flex:1 1 480px; min-width:0; overflow-x:auto; }
.plot .grid line { stroke:var(--line); stroke-width:1; } .plot .frame { fill:none; stroke:var(--soft); }
.plot .front { fill:none; stroke-width:1.8; stroke-opacity:.75; } .plot .floor { stroke:#444; stroke-dasharray:6 4; }
.plot .bar line { stroke-opacity:.55; stroke-width:1.2; } .plot .faded { opacity:.3; } .plot .ring { fill:none; stroke:#111; stroke-width:1.6; }
.plot a:focus, .plot g.point:hover { filter:brightness(.7); } .plot text.axis { font-size:13px; } .plot text { font-size:12px; fill:var(--ink); }
#tip { position:absolute; z-index:3; background:#fff; border:1px solid var(--soft); border-radius:6px; padding:6px 9px;
  font-size:12.5px; max-width:420px; pointer-events:none; white-space:pre-line; box-shadow:0 2px 8px #0003; }
table.sortable caption { text-align:left; font-weight:600; font-size:13.5px; padding:8px 0 4px; }
table.sortable th { cursor:pointer; } table.sortable th[aria-sort=ascending]::after { content:' \25b2'; font-size:10px; }
table.sortable th[aria-sort=descending]::after { content:' \25bc'; font-size:10px; }
table.sortable td.num { white-space:normal; min-width:74px; } .limits td { font-size:12.5px; }
a.csv { font-weight:400; margin-left:8px; } td.best { color:#1a7f37; font-weight:600; } td.failed { background:#ffebe9; }
td.soft { color:var(--soft); } .failedtext { color:#b3261e; } .tablebox { overflow-x:auto; margin-bottom:12px; }
.warning { background:#fff8c5; border:1px solid #eac54f; border-radius:6px; padding:8px 10px; }
)css";

}  // namespace relight::page
