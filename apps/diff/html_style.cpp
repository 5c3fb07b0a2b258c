#include "apps/diff/html_assets.h"

namespace penumbra::diff {

std::string_view html_style() {
    return R"css(
:root { color-scheme: dark; --line: #3a3d44; --panel: #22252b; --bad: #ff7b6b; --good: #7bd88f; }
body { margin: 0 auto; max-width: 1400px; padding: 16px; background: #17191d; color: #e4e6ea;
       font: 14px/1.45 system-ui, sans-serif; }
h1 { font-size: 20px; } h2 { font-size: 16px; margin: 0 0 6px; overflow-wrap: anywhere; }
section { border: 1px solid var(--line); border-radius: 8px; background: var(--panel);
          padding: 12px; margin: 12px 0; }
.failed { color: var(--bad); } .passed { color: var(--good); }
.files { color: #a8adb7; overflow-wrap: anywhere; }
table { border-collapse: collapse; margin: 8px 0; font-variant-numeric: tabular-nums; }
th, td { border: 1px solid var(--line); padding: 3px 9px; text-align: right; }
th:first-child, td:first-child { text-align: left; }
.scroll { overflow-x: auto; }
ul { margin: 6px 0; padding-left: 20px; }
.bar { display: flex; flex-wrap: wrap; gap: 6px; align-items: center; margin: 8px 0; }
button, select { background: #2e323a; color: inherit; border: 1px solid var(--line);
                 border-radius: 5px; padding: 4px 10px; font: inherit; cursor: pointer; }
button[aria-pressed="true"] { background: #3f66a8; border-color: #6c93d6; }
.stage { position: relative; overflow: hidden; height: 60vh; min-height: 240px; background: #000;
         border: 1px solid var(--line); touch-action: none; cursor: grab; user-select: none; }
.stage img { position: absolute; left: 0; top: 0; transform-origin: 0 0; max-width: none; }
.stage.pixels img, .worst img { image-rendering: pixelated; }
.stage .tag { position: absolute; top: 6px; padding: 1px 8px; background: #000b; border-radius: 4px;
              pointer-events: none; }
.stage .tag.left { left: 6px; } .stage .tag.right { right: 6px; }
.stage .half { position: absolute; top: 0; bottom: 0; width: 50%; overflow: hidden; }
.stage .divider { position: absolute; top: 0; bottom: 0; width: 18px; margin-left: -9px;
                  cursor: ew-resize; }
.stage .divider::after { content: ""; position: absolute; left: 8px; top: 0; bottom: 0; width: 2px;
                         background: #fff; }
.worst { display: flex; flex-wrap: wrap; gap: 12px; }
.worst figure { margin: 0; cursor: pointer; } .worst figure:hover { outline: 2px solid #6c93d6; }
.worst .trio { display: flex; gap: 2px; } .worst img { width: 128px; height: auto; }
.worst figure.large { width: 100%; } .worst figure.large img { width: 32%; }
figcaption { color: #a8adb7; font-size: 12px; }
)css";
}

}  // namespace penumbra::diff
