// A recorded storm (`storm`, put before this by pack.mjs) on the start page: who knows whom, and what waits, once and again.
// It leads to the page that simulates.
(() => {
  const place = document.getElementById("storm");
  if (!place) return;
  const canvas = document.createElement("canvas");
  canvas.width = 720;
  canvas.height = 240;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${storm.headline}: ${storm.sentence}`);
  canvas.style.cssText = "width: 100%; max-width: 720px; height: auto; display: block";
  const words = document.createElement("p");
  const link = document.createElement("a");
  link.href = "play.html#scenario=wifi-5x20-fastdds";
  link.textContent = "Play with it";
  words.append(`Two robots on one Wi-Fi, ten participants. ${storm.headline}: ${storm.sentence}. `, link, ".");
  place.replaceChildren(canvas, words);

  const known = Uint8Array.from(atob(storm.known), (c) => c.charCodeAt(0));
  const pen = canvas.getContext("2d");
  const size = storm.hosts.length;
  const largest = Math.max(1, ...storm.pictures.map((p) => p[1] + p[2]));
  const draw = (n) => {
    const text = getComputedStyle(place).color;
    pen.clearRect(0, 0, 720, 240);
    const cell = 220 / size;
    for (let i = 0; i < size; ++i) {
      for (let j = 0; j < size; ++j) {
        const part = i === j ? 0 : known[(n * size + i) * size + j] / 255;
        pen.globalAlpha = i === j ? 0.05 : 0.12 + 0.88 * part;
        pen.fillStyle = part > 0 ? "#3f7fdf" : text;
        pen.fillRect(8 + j * cell, 8 + i * cell, cell - 2, cell - 2);
      }
    }
    pen.globalAlpha = 1;
    pen.fillStyle = "#c2570c";
    const width = 440 / storm.pictures.length;
    storm.pictures.slice(0, n + 1).forEach((p, k) => {
      const height = ((p[1] + p[2]) / largest) * 180;
      pen.fillRect(264 + k * width, 208 - height, Math.max(1, width - 0.5), height);
    });
    pen.fillStyle = text;
    pen.font = "14px sans-serif";
    pen.fillText(`${(storm.pictures[n][0] / 1e9).toFixed(2)} s: what waits for the channel`, 264, 228);
  };
  const last = storm.pictures.length - 1;
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return draw(last);
  const begin = performance.now();
  const frame = (now) => {
    draw(Math.min(last, Math.floor((Math.max(0, now - begin) % 9000) / 60)));
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
})();
