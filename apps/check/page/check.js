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

  // Golden, new and difference at a glance; a click shows one of them in the viewer below.
  for (const viewer of document.querySelectorAll(".frame .viewer")) {
    const stage = viewer.querySelector(".stage");
    const labels = viewer.closest("[data-labels]").dataset.labels.split(",");
    const glance = document.createElement("div");
    glance.className = "glance";
    ["reference", "test", "heat"].forEach((key, i) => {
      const figure = document.createElement("figure");
      const caption = document.createElement("figcaption");
      const image = new Image();
      image.src = stage.dataset[key];
      image.alt = caption.textContent = labels[i];
      figure.append(image, caption);
      figure.onclick = () => {
        viewer.querySelector(`[data-mode="${i === 2 ? "heat" : "side"}"]`).click();
        stage.scrollIntoView({ block: "nearest" });
      };
      glance.append(figure);
    });
    viewer.prepend(glance);
  }

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
