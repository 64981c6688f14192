// Draws the Mermaid blocks of a page, if the library is there (build.py says); otherwise they stay text.
if (typeof mermaid !== "undefined") {
  const dark = document.body.getAttribute("data-md-color-scheme") === "slate";
  mermaid.initialize({ startOnLoad: false, theme: dark ? "dark" : "default" });
  document.querySelectorAll("pre.diagram").forEach((block) => {
    const drawing = document.createElement("div");
    drawing.className = "diagram";
    drawing.textContent = block.textContent;
    block.replaceWith(drawing);
  });
  mermaid.init(undefined, "div.diagram");
}
