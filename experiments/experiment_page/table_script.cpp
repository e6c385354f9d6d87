#include "experiments/experiment_page/page_parts.h"

namespace relight::page {

// Click on a column's title: sorts; by number where the cells have one, cells without go last. Each table's
// CSV is in its link's address, so that it works without a network, in the order that is shown.
const char* const table_script = R"js(
(() => {
  const value = cell => cell.dataset.v === undefined ? NaN : Number(cell.dataset.v);
  const isNumber = (table, column) => table.tHead.rows[0].cells[column].classList.contains('num');
  const quoted = text => /[",\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;

  function csv(table) {
    const heads = [...table.tHead.rows[0].cells].map(th => quoted(th.textContent));
    const rows = [...table.tBodies[0].rows].map(row => [...row.cells].map((cell, i) =>
      isNumber(table, i) ? cell.dataset.v ?? '' : quoted(cell.textContent)).join(','));
    return [heads.join(','), ...rows].join('\n') + '\n';
  }
  function refresh(table) {
    table.querySelector('a.csv').href = 'data:text/csv;charset=utf-8,' + encodeURIComponent(csv(table));
  }
  function compare(a, b) {
    const x = value(a), y = value(b);
    if (Number.isNaN(x) && Number.isNaN(y)) return a.textContent.localeCompare(b.textContent, 'en', {numeric: true});
    return x - y;
  }
  function sort(table, column) {
    const head = table.tHead.rows[0].cells[column], falling = head.getAttribute('aria-sort') === 'ascending';
    for (const th of table.tHead.rows[0].cells) th.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', falling ? 'descending' : 'ascending');
    const unknown = row => isNumber(table, column) && Number.isNaN(value(row.cells[column]));
    const rows = [...table.tBodies[0].rows].sort((a, b) =>
      unknown(a) - unknown(b) || (falling ? -1 : 1) * compare(a.cells[column], b.cells[column]));
    table.tBodies[0].replaceChildren(...rows);
    refresh(table);
  }
  for (const table of document.querySelectorAll('table.sortable')) {
    [...table.tHead.rows[0].cells].forEach((th, column) => {
      th.addEventListener('click', () => sort(table, column));
      th.addEventListener('keydown', e => { if (e.key === 'Enter') sort(table, column); });
    });
    refresh(table);
  }
})();
)js";

}  // namespace relight::page
