"use strict";
// Paper cannot be clicked: what is folded away is open while the page is printed.
const opened = [];
addEventListener("beforeprint", () => {
  for (const folded of document.querySelectorAll("details:not([open])")) {
    folded.open = true;
    opened.push(folded);
  }
});
addEventListener("afterprint", () => { for (const folded of opened.splice(0)) folded.open = false; });
