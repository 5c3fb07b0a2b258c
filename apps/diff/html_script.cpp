#include "apps/diff/html_assets.h"

namespace penumbra::diff {

std::string_view html_script() {
    return R"js(
"use strict";
// One viewer per <div class="viewer">: its <img>s are the reference, the test and the error map.
function viewer(root) {
  const stage = root.querySelector(".stage");
  const source = ["reference", "test", "heat"].map(k => stage.dataset[k]);
  const labels = ["reference", "test", "error map"];
  const state = { mode: "flip", shown: 0, scale: 1, x: 0, y: 0, split: 0.5, timer: null };
  const picture = i => { const e = new Image(); e.src = source[i]; e.alt = labels[i];
                         e.draggable = false; return e; };
  const size = new Image();
  const fit = () => {
    state.scale = Math.min(stage.clientWidth / (state.mode === "side" ? 2 : 1) / size.naturalWidth,
                           stage.clientHeight / size.naturalHeight);
    state.x = state.y = 0;
    place();
  };
  const place = () => {
    stage.classList.toggle("pixels", state.scale > 1);
    for (const e of stage.querySelectorAll("img"))
      e.style.transform = `translate(${state.x}px,${state.y}px) scale(${state.scale})`;
    const over = stage.querySelector(".over");
    if (over) {
      const at = state.split * stage.clientWidth;
      over.style.clipPath = `inset(0 0 0 ${at}px)`;
      stage.querySelector(".divider").style.left = at + "px";
    }
    root.querySelector(".percent").textContent = Math.round(state.scale * 100) + " %";
  };
  const tag = (text, side) => {
    const e = document.createElement("span");
    e.className = "tag " + side; e.textContent = text; return e;
  };
  const box = (className, ...children) => {
    const e = document.createElement("div");
    e.className = className; e.append(...children); return e;
  };
  const show = () => {
    stage.replaceChildren();
    if (state.mode === "flip") stage.append(picture(state.shown), tag(labels[state.shown], "left"));
    if (state.mode === "heat") stage.append(picture(2), tag(labels[2], "left"));
    if (state.mode === "slider") {
      const over = box("over", picture(1));
      over.style.cssText = "position:absolute;inset:0";
      stage.append(picture(0), over, tag(labels[0], "left"), tag(labels[1], "right"),
                   box("divider"));
    }
    if (state.mode === "side")
      [0, 1].forEach(i => {
        const half = box("half", picture(i), tag(labels[i], "left"));
        half.style.left = 50 * i + "%";
        stage.append(half);
      });
    for (const b of root.querySelectorAll("[data-mode]"))
      b.setAttribute("aria-pressed", b.dataset.mode === state.mode);
    root.querySelector(".auto").setAttribute("aria-pressed", state.timer !== null);
    place();
  };
  const stop = () => { clearInterval(state.timer); state.timer = null; };
  const swap = () => { state.shown = 1 - state.shown; show(); };
  const zoom = (factor, x, y) => {
    const scale = Math.min(Math.max(state.scale * factor, 0.02), 64);
    state.x = x - (x - state.x) * scale / state.scale;
    state.y = y - (y - state.y) * scale / state.scale;
    state.scale = scale;
    place();
  };
  const center = () => [stage.clientWidth / (state.mode === "side" ? 4 : 2),
                        stage.clientHeight / 2];
  for (const b of root.querySelectorAll("[data-mode]"))
    b.onclick = () => {
      const wasSide = state.mode === "side";
      stop(); state.mode = b.dataset.mode; show();
      if (wasSide !== (state.mode === "side")) fit();
    };
  root.querySelector(".swap").onclick = () => { stop(); state.mode = "flip"; swap(); };
  root.querySelector(".auto").onclick = () => {
    const runs = state.timer !== null;
    stop(); state.mode = "flip";
    if (!runs) state.timer = setInterval(swap, 500);
    show();
  };
  root.querySelector(".in").onclick = () => zoom(2, ...center());
  root.querySelector(".out").onclick = () => zoom(0.5, ...center());
  root.querySelector(".one").onclick = () => zoom(1 / state.scale, ...center());
  root.querySelector(".fit").onclick = fit;
  stage.addEventListener("wheel", e => {
    e.preventDefault();
    const r = stage.getBoundingClientRect();
    const half = state.mode === "side" ? r.width / 2 : r.width;
    zoom(Math.exp(-e.deltaY / 400), (e.clientX - r.left) % half, e.clientY - r.top);
  }, { passive: false });
  let drag = null;
  stage.addEventListener("pointerdown", e => {
    drag = { x: e.clientX, y: e.clientY, split: e.target.classList.contains("divider"), far: 0 };
    stage.setPointerCapture(e.pointerId);
  });
  stage.addEventListener("pointermove", e => {
    if (!drag) return;
    const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
    drag.x = e.clientX; drag.y = e.clientY; drag.far += Math.abs(dx) + Math.abs(dy);
    if (drag.split)
      state.split = Math.min(Math.max(state.split + dx / stage.clientWidth, 0), 1);
    else { state.x += dx; state.y += dy; }
    place();
  });
  stage.addEventListener("pointerup", () => {
    if (drag && drag.far < 4 && state.mode === "flip") { stop(); swap(); }
    drag = null;
  });
  stage.addEventListener("keydown", e => {
    if (e.key === " ") { e.preventDefault(); stop(); state.mode = "flip"; swap(); }
    if (e.key === "+") zoom(2, ...center());
    if (e.key === "-") zoom(0.5, ...center());
    if (e.key === "0") fit();
  });
  for (const figure of root.querySelectorAll(".worst figure"))
    figure.onclick = () => figure.classList.toggle("large");
  for (const b of root.querySelectorAll(".go"))
    b.onclick = e => {
      e.stopPropagation();
      const reduction = Number(stage.dataset.reduction);
      state.scale = 8 * reduction;
      const [cx, cy] = center();
      state.x = cx - Number(b.dataset.x) / reduction * state.scale;
      state.y = cy - Number(b.dataset.y) / reduction * state.scale;
      place();
      stage.scrollIntoView({ block: "nearest" });
    };
  size.onload = () => { fit(); show(); };
  size.src = source[0];
  window.addEventListener("resize", place);
}
for (const root of document.querySelectorAll(".viewer")) viewer(root);
for (const choice of document.querySelectorAll("select.layers")) {
  const views = [...choice.closest("section").querySelectorAll(".viewer")];
  const pick = () => {
    views.forEach((view, i) => { view.hidden = i !== choice.selectedIndex; });
    views[choice.selectedIndex].querySelector(".fit").click();
  };
  choice.onchange = pick;
}
)js";
}

}  // namespace penumbra::diff
