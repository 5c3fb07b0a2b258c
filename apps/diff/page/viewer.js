"use strict";
// One viewer per <div class="viewer">: its stage names the pictures of the reference, the test and
// the error map. Nothing is decoded before the viewer is seen.
function viewer(root) {
  const stage = root.querySelector(".stage");
  const source = ["reference", "test", "heat"].map(k => stage.dataset[k]);
  // Other reports have other names for them.
  const labels = (root.closest("[data-labels]")?.dataset.labels ?? "reference,test,error map")
                     .split(",");
  const state = { mode: "flip", shown: 0, scale: 1, x: 0, y: 0, split: 0.5, timer: null };
  const size = new Image();

  const picture = i => {
    const e = new Image();
    e.src = source[i]; e.alt = labels[i]; e.draggable = false;
    return e;
  };
  const tag = (text, side) => {
    const e = document.createElement("span");
    e.className = "tag " + side; e.textContent = text;
    return e;
  };
  const box = (className, ...children) => {
    const e = document.createElement("div");
    e.className = className; e.append(...children);
    return e;
  };

  // Where the pictures are: after each change of scale, place and split.
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
  // Which pictures there are: after each change of the mode.
  const show = () => {
    stage.replaceChildren();
    if (state.mode === "flip") stage.append(picture(state.shown), tag(labels[state.shown], "left"));
    if (state.mode === "heat") stage.append(picture(2), tag(labels[2], "left"));
    if (state.mode === "slider")
      stage.append(picture(0), box("over", picture(1)), tag(labels[0], "left"),
                   tag(labels[1], "right"), box("divider"));
    if (state.mode === "side")
      for (const i of [0, 1]) {
        const half = box("half", picture(i), tag(labels[i], "left"));
        half.style.left = 50 * i + "%";
        stage.append(half);
      }
    for (const b of root.querySelectorAll("[data-mode]"))
      b.setAttribute("aria-pressed", b.dataset.mode === state.mode);
    root.querySelector(".auto").setAttribute("aria-pressed", state.timer !== null);
    place();
  };

  const width = () => stage.clientWidth / (state.mode === "side" ? 2 : 1);
  const center = () => [width() / 2, stage.clientHeight / 2];
  const fit = () => {
    if (!size.naturalWidth) return;
    state.scale = Math.min(width() / size.naturalWidth, stage.clientHeight / size.naturalHeight);
    state.x = state.y = 0;
    place();
  };
  const zoom = (factor, x, y) => {
    const scale = Math.min(Math.max(state.scale * factor, 0.02), 64);
    state.x = x - (x - state.x) * scale / state.scale;
    state.y = y - (y - state.y) * scale / state.scale;
    state.scale = scale;
    place();
  };
  const stop = () => { clearInterval(state.timer); state.timer = null; };
  const change = mode => {
    const wasSide = state.mode === "side";
    stop(); state.mode = mode; show();
    if (wasSide !== (mode === "side")) fit();
  };
  const flip = () => { state.shown = 1 - state.shown; show(); };
  const swap = () => { change("flip"); flip(); };
  const blink = () => {
    const runs = state.timer !== null;
    change("flip");
    if (!runs) state.timer = setInterval(flip, 500);
    show();
  };
  const goTo = (x, y) => {
    const reduction = Number(stage.dataset.reduction);
    const [cx, cy] = center();
    state.scale = 8 * reduction;
    state.x = cx - x / reduction * state.scale;
    state.y = cy - y / reduction * state.scale;
    place();
    stage.scrollIntoView({ block: "nearest" });
  };

  for (const b of root.querySelectorAll("[data-mode]")) b.onclick = () => change(b.dataset.mode);
  root.querySelector(".swap").onclick = swap;
  root.querySelector(".auto").onclick = blink;
  root.querySelector(".in").onclick = () => zoom(2, ...center());
  root.querySelector(".out").onclick = () => zoom(0.5, ...center());
  root.querySelector(".one").onclick = () => zoom(1 / state.scale, ...center());
  root.querySelector(".fit").onclick = fit;
  stage.addEventListener("keydown", e => {
    const action = { " ": swap, "+": () => zoom(2, ...center()), "-": () => zoom(0.5, ...center()),
                     "0": fit }[e.key];
    if (!action) return;
    e.preventDefault();
    action();
  });
  stage.addEventListener("wheel", e => {
    e.preventDefault();
    const r = stage.getBoundingClientRect();
    zoom(Math.exp(-e.deltaY / 400), (e.clientX - r.left) % width(), e.clientY - r.top);
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
    if (drag && drag.far < 4 && state.mode === "flip") swap();
    drag = null;
  });

  for (const figure of root.querySelectorAll(".worst figure"))
    figure.onclick = () => figure.classList.toggle("large");
  for (const b of root.querySelectorAll(".go"))
    b.onclick = e => { e.stopPropagation(); goTo(Number(b.dataset.x), Number(b.dataset.y)); };

  size.onload = () => { fit(); show(); };
  size.src = source[0];
  window.addEventListener("resize", place);
}

const seen = new IntersectionObserver(entries => {
  for (const entry of entries)
    if (entry.isIntersecting) { seen.unobserve(entry.target); viewer(entry.target); }
}, { rootMargin: "200px" });
for (const root of document.querySelectorAll(".viewer")) seen.observe(root);

for (const choice of document.querySelectorAll("select.layers")) {
  const views = [...choice.closest("section").querySelectorAll(".viewer")];
  choice.onchange = () => views.forEach((view, i) => { view.hidden = i !== choice.selectedIndex; });
}
