"use strict";
// A click on a column's head sorts its table; without scripts the tables stand as they are written.
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
function worth(text) {
  const found = /^(?:< )?(-?[0-9.]+)(?:×10([⁻⁰¹²³⁴-⁹]+))?/.exec(text.replace(/[\u202f\u00a0]/g, ""));
  if (!found) return Infinity;
  const power = (found[2] || "⁰").replace(/./g, sign => sign === "⁻" ? "-" : RAISED.indexOf(sign));
  return Number(found[1]) * 10 ** Number(power);
}
for (const head of document.querySelectorAll("thead th")) {
  const button = document.createElement("button");
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    const text = row => row.cells[head.cellIndex].textContent.trim();
    const numbers = (a, b) => (worth(text(a)) - worth(text(b))) || 0;
    const words = (a, b) => text(a).localeCompare(text(b));
    const order = head.classList.contains("number") ? numbers : words;
    const body = head.closest("table").tBodies[0];
    for (const other of head.parentNode.cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down === 1 ? "ascending" : "descending");
    body.append(...[...body.rows].sort((a, b) => down * order(a, b)));
  });
}
