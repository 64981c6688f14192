// The script of the pages: themes, steppers, and details that open for paper. It stores nothing,
// asks nobody, and makes no HTML out of text.
#include "checker/presentation/document/html_page.hpp"

namespace stormproof::report {

namespace {

constexpr std::string_view script = R"js(
(() => {
  "use strict";
  const root = document.documentElement;
  root.classList.add("js");
  for (const part of document.querySelectorAll(".only-script")) part.hidden = false;

  const theme = document.getElementById("theme");
  const preference = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () =>
    root.dataset.theme ? root.dataset.theme === "dark" : preference.matches;
  const nameTheme = () => { theme.textContent = isDark() ? "Light colours" : "Dark colours"; };
  theme.addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    nameTheme();
  });
  preference.addEventListener("change", nameTheme);
  nameTheme();

  const statesOf = (step, machine) => {
    const names = new Set();
    for (const row of step.querySelectorAll("tr[data-of]"))
      if (row.dataset.of === machine)
        for (const name of row.dataset.states.split(" ")) names.add(name);
    return names;
  };
  const markMachines = (step) => {
    for (const figure of document.querySelectorAll("[data-machine]")) {
      const names = statesOf(step, figure.dataset.machine);
      for (const title of figure.querySelectorAll("text.bold")) {
        const box = title.previousElementSibling;
        if (box && box.classList.contains("state"))
          box.classList.toggle("active", names.has(title.textContent));
      }
    }
  };

  const makeStepper = (box) => {
    const steps = [...box.querySelectorAll(".steps > li")];
    const drawing = document.getElementById(box.dataset.drawing);
    const slider = box.querySelector("input");
    const position = box.querySelector("output");
    const spoken = box.querySelector("[aria-live]");
    const button = (name) => box.querySelector("[data-go=" + name + "]");
    let at = 0;
    let timer = 0;

    const mark = (step) => {
      if (!drawing) return;
      for (const old of drawing.querySelectorAll(".current")) old.classList.remove("current");
      const row = drawing.querySelector(".row.r" + step.dataset.row);
      if (!row) return;
      row.classList.add("current");
      for (const packet of step.dataset.packets.split(" ").filter(Boolean))
        for (const part of drawing.querySelectorAll(".w" + packet)) part.classList.add("current");
      const area = drawing.closest(".drawing");
      const inside = row.getBoundingClientRect();
      const outside = area.getBoundingClientRect();
      area.scrollTop += inside.top - outside.top - (area.clientHeight - inside.height) / 2;
    };
    const show = (to, speak) => {
      at = Math.max(0, Math.min(steps.length - 1, to));
      steps.forEach((step, k) => {
        step.classList.toggle("current", k === at);
        if (k === at) step.setAttribute("aria-current", "step");
        else step.removeAttribute("aria-current");
      });
      const place = "step " + (at + 1) + " of " + steps.length;
      const words = place + ": " + steps[at].querySelector(".when").textContent;
      position.value = place;
      slider.value = at;
      slider.setAttribute("aria-valuetext", words);
      for (const name of ["first", "previous"])
        button(name).setAttribute("aria-disabled", at === 0);
      for (const name of ["next", "last"])
        button(name).setAttribute("aria-disabled", at === steps.length - 1);
      mark(steps[at]);
      if (!speak) return;
      markMachines(steps[at]);
      spoken.textContent = words + ", " + steps[at].querySelector(".acts").textContent;
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      button("play").textContent = "▶ play";
    };
    const to = (position) => () => { stop(); show(position(), true); };
    const go = {
      first: to(() => 0),
      previous: to(() => at - 1),
      next: to(() => at + 1),
      last: to(() => steps.length - 1),
      play: () => {
        if (timer) { stop(); return; }
        if (at === steps.length - 1) show(0, true);
        button("play").textContent = "❚❚ pause";
        timer = setInterval(() => {
          show(at + 1, true);
          if (at === steps.length - 1) stop();
        }, 1000);
      }
    };
    for (const name of Object.keys(go)) button(name).addEventListener("click", go[name]);
    slider.addEventListener("input", to(() => Number(slider.value)));
    show(0, false);
    return { box, walk: box.closest(".walk") || box, go };
  };
  const steppers = [...document.querySelectorAll(".stepper")].map(makeStepper);
  if (steppers.length > 0) markMachines(steppers[0].box.querySelector(".current"));

  const keys = { ArrowLeft: "previous", ArrowRight: "next", Home: "first", End: "last",
                 " ": "play" };
  const hasOwnUse = (target, key) => {
    if (!(target instanceof Element)) return false;
    if (target.closest("input:not([type=range]), select, textarea, [contenteditable]")) return true;
    if (key === " ") return target.closest("button, summary, a") !== null;
    const area = target.closest(".scroll");
    return area !== null && key.startsWith("Arrow") && area.scrollWidth > area.clientWidth;
  };
  const distance = (stepper) => {
    const area = stepper.walk.getBoundingClientRect();
    if (area.bottom < 0 || area.top > innerHeight) return Infinity;
    const middle = innerHeight / 2;
    return Math.max(area.top - middle, middle - area.bottom, 0);
  };
  const nearest = () => {
    const seen = steppers.filter((stepper) => distance(stepper) < Infinity);
    return seen.sort((a, b) => distance(a) - distance(b))[0];
  };
  document.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    if (event.defaultPrevented || hasOwnUse(event.target, event.key)) return;
    const own = steppers.find((stepper) => stepper.box.contains(event.target));
    const chosen = own || nearest();
    if (!chosen) return;
    event.preventDefault();
    chosen.go[action]();
  });

  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")];
    for (const part of folded) part.open = true;
  });
  addEventListener("afterprint", () => { for (const part of folded) part.open = false; });
})();
)js";

}  // namespace

std::string_view page_script() { return script; }

}  // namespace stormproof::report
