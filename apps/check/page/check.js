"use strict";
// Which checks are shown: by verdict and by a part of the name.
{
  const bar = document.querySelector(".filter");
  const text = bar.querySelector("input");
  const buttons = [...bar.querySelectorAll("button")];
  const checks = [...document.querySelectorAll("section.check")];
  const apply = () => {
    const wanted = new Set(buttons.filter(b => b.getAttribute("aria-pressed") === "true")
                                  .map(b => b.dataset.verdict));
    for (const check of checks)
      check.hidden = !wanted.has(check.dataset.verdict) ||
                     !check.dataset.name.includes(text.value);
    window.dispatchEvent(new Event("resize"));
  };
  for (const button of buttons)
    button.onclick = () => {
      button.setAttribute("aria-pressed", button.getAttribute("aria-pressed") !== "true");
      apply();
    };
  text.oninput = apply;

  // Pages opened from a file may lack the clipboard of secure ones.
  const copy = async code => {
    try {
      await navigator.clipboard.writeText(code.textContent);
      return true;
    } catch {
      getSelection().selectAllChildren(code);
      return document.execCommand("copy");
    }
  };
  for (const button of document.querySelectorAll(".copy"))
    button.onclick = async () => {
      const done = await copy(button.parentElement.querySelector("code"));
      button.textContent = done ? "Copied" : "Press Ctrl+C";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    };
}
