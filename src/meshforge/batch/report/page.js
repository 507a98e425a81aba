"use strict";
(() => {
  const all = (selector) => [...document.querySelectorAll(selector)];
  const stages = all(".stage.pair");
  const assets = all(".asset");
  const cut = (stage, value) => stage.style.setProperty("--cut", value + "%");

  for (const stage of stages) {
    const slider = stage.querySelector("input");
    slider.addEventListener("input", () => cut(stage, slider.value));
  }

  const every = document.getElementById("every");
  every?.addEventListener("input", () => {
    for (const stage of stages) {
      stage.querySelector("input").value = every.value;
      cut(stage, every.value);
    }
  });

  const pressed = (group, button) => {
    for (const other of group.querySelectorAll("button")) {
      other.setAttribute("aria-pressed", String(other === button));
    }
  };

  let kind = "";
  const find = document.getElementById("find");
  const filter = () => {
    const words = find.value.trim().toLowerCase();
    for (const asset of assets) {
      const fits = (!kind || asset.dataset.kind.split(" ").includes(kind)) && asset.dataset.name.includes(words);
      asset.hidden = !fits;
    }
  };
  find.addEventListener("input", filter);
  document.getElementById("kinds").addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    kind = button.dataset.kind;
    pressed(button.parentElement, button);
    filter();
  });
  document.getElementById("modes")?.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    document.body.classList.toggle("changes", button.dataset.mode === "changes");
    pressed(button.parentElement, button);
  });

  document.querySelector(".tools").hidden = false;
})();
