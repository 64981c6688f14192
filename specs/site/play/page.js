// The page that simulates. `constants` (machines, classes), `library` (shipped scenarios, exhibits, names of profiles) and
// `guide` (where a rule is explained) are put before this by pack.mjs. Nothing here knows a rule of a protocol: the
// engine in the worker does, and this draws what it says.
const $ = (id) => document.getElementById(id);
const pictures = 240;

// ---- The engine: one worker for the run that is looked at, one for the runs under other seeds.
const unpack = async (id) => {
  const bytes = Uint8Array.from(atob($(id).textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
};
const unpacked = Promise.all([unpack("engine"), unpack("module")]);

class Engine {
  constructor() {
    this.calls = new Map();
    this.restart();
  }
  /// Whatever runs is given up; who waits for it is told.
  restart() {
    this.worker?.terminate();
    this.worker = undefined;
    for (const call of this.calls.values()) call.reject(new Error("given up"));
    this.calls = new Map();
    this.number = 0;
    const started = this.started = unpacked.then(([text, module]) => {
      if (started !== this.started) throw new Error("given up");
      const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
      const worker = this.worker = new Worker(url);
      worker.onmessage = ({ data }) => {
        const call = this.calls.get(data.id);
        this.calls.delete(data.id);
        if (data.failure !== undefined) call?.reject(new Error(data.failure)); else call?.resolve(data.answer);
      };
      worker.postMessage({ module });
      return worker;
    });
  }
  async call(call, ...args) {
    const worker = await this.started;
    return new Promise((resolve, reject) => {
      const id = ++this.number;
      this.calls.set(id, { resolve, reject });
      worker.postMessage({ id, call, args });
    });
  }
}
const runner = new Engine();
const sampler = new Engine();

// ---- The scenario: what the controls say, a shipped one, an exhibit, or YAML of one's own. The address holds it.
const knobs = ["robots", "processes", "endpoints", "spread", "seed", "dds", "wireless", "buffer"];
const milliseconds = (value) => `${Math.round(value * 1000) / 1000}ms`;

const yamlOfKnobs = () => {
  const v = Object.fromEntries(knobs.map((name) => [name, $(name).value]));
  const buffer = Number(v.buffer);
  const shared = v.wireless !== "wired";
  const dds = buffer && v.dds.startsWith("fastdds")
    ? `{base: ${v.dds}, sedp: {piggyback_threshold_bytes: ${buffer}}}` : v.dds;
  const wireless = buffer && shared ? `{base: ${v.wireless}, source_queue_bytes: ${buffer}}` : v.wireless;
  // A paper's participant has its endpoints when it starts; others create them, as in wifi-5x20-fastdds.
  const done = v.dds === "paper" ? ""
    : `\n    endpoints_done: [50.8ms, ${milliseconds(Number(v.spread) + 74.175)}]`;
  return `deployment:
  hosts: ${v.robots}
  participants_per_host: ${v.processes}
  endpoints_per_participant: ${v.endpoints}
  loopback_delay: 60us
  schedule:
    start: [3ms, ${v.spread}ms]${done}
    seed: ${v.seed || 0}
dds: ${dds}
wireless: ${wireless}
time_limit: 200s
`;
};

/// Whether what is open is what the controls say.
const showKnobs = () => {
  const other = $("yaml").value !== yamlOfKnobs();
  $("knobs").classList.toggle("other", other);
  $("apart").hidden = !other;
  for (const input of document.querySelectorAll("#knobs input[type=range]")) {
    input.previousElementSibling.value = input.id === "spread" ? `${input.value} ms` : input.value;
  }
};

const writeAddress = (text) => history.replaceState(null, "", `#${text}`);

const readAddress = () => {
  const given = new URLSearchParams(location.hash.slice(1));
  const known = (list, name) => (name in list ? list[name] : undefined);
  $("preset").value = "";
  if (given.has("yaml")) {
    $("yaml").value = given.get("yaml");
    $("source").open = true;
  } else if (given.has("scenario") || given.has("exhibit")) {
    const [kind, list] = given.has("scenario") ? ["scenario", library.scenarios] : ["exhibit", library.exhibits];
    const name = given.get(kind);
    if (known(list, name) === undefined) return complain(`#${kind}=${name}`, `no ${kind} of this name`);
    $("yaml").value = list[name].yaml;
    $("preset").value = `${kind}=${name}`;
  } else {
    for (const name of knobs) {
      if (!given.has(name)) continue;
      $(name).value = given.get(name);
      if ($(name).value !== given.get(name)) {
        return complain(`#${name}=${given.get(name)}`, "not a value that this control has");
      }
    }
    $("yaml").value = yamlOfKnobs();
  }
  showKnobs();
  run();
};

const complain = (where, what) => {
  $("error").textContent = `${where}: ${what}`;
  $("error").hidden = false;
  $("verdict").className = "banner warn";
  $("verdict").replaceChildren(element("p", { className: "verdict-line" }, "Nothing was simulated"));
  document.body.dataset.state = "refused";
};

// ---- Elements and numbers.
const element = (name, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};
const drawn = (name, attributes = {}, text = "") => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text) made.textContent = text;
  return made;
};
const exact = (ns) => `${Math.floor(ns / 1e9)}.${String(ns % 1e9).padStart(9, "0")} s`;
const rough = (ns) => (ns >= 1e10 ? `${(ns / 1e9).toFixed(1)} s` : ns >= 1e9 ? `${(ns / 1e9).toFixed(2)} s`
  : `${(ns / 1e6).toFixed(1)} ms`);
const many = (count) => count.toLocaleString("en").replace(/,/g, "\u202f");

// ---- One run.
let generation = 0;  // of the scenario; answers to an older one are not shown
let scenario, film;
let at = { picture: 0, event: 0 };

const run = async () => {
  const mine = ++generation;
  stopPlaying();
  $("error").hidden = true;
  document.body.dataset.state = "running";
  $("stop").hidden = false;
  try {
    const opened = await runner.call("open", $("yaml").value);
    if (mine !== generation) return;
    if (opened.error) return complain(opened.error.where, opened.error.what);
    scenario = opened;
    film = undefined;
    const result = await runner.call("record", pictures);
    if (mine !== generation) return;
    film = result;
    showRun();
    sample(mine);
  } catch (failure) {
    if (mine !== generation) return;
    complain("engine", failure.message);
    runner.restart();  // what has failed in its middle cannot go on
  } finally {
    if (mine === generation) $("stop").hidden = true;
  }
};

const showRun = () => {
  const verdicts = { fine: "good", storm: "bad", incomplete: "bad" };
  $("verdict").className = `banner ${verdicts[film.health.name] || "warn"}`;
  $("verdict").replaceChildren(element("p", { className: "verdict-line" }, film.health.headline),
    element("p", {}, `${film.health.sentence[0].toUpperCase()}${film.health.sentence.slice(1)}.`));
  const rows = [["discovery complete at", film.t_disc_ns === null ? "not within the run" : exact(film.t_disc_ns)],
    ["end of the run", exact(film.end_ns)], ["events", many(film.events)], ["deliveries that are missing", many(film.missing)],
    ...Object.entries(film.counts).map(([name, count]) => [`messages, ${name.replace(/_/g, " ")}`, many(count)]),
    ["messages of user topics", many(film.user_control)],
    ...film.channels.map((one) => [`${one.name} busy`, exact(one.busy_ns.reduce((a, b) => a + b, 0))])];
  $("numbers").querySelector("tbody").replaceChildren(...rows.map(([name, value]) =>
    element("tr", {}, element("th", { scope: "row" }, name), element("td", { className: "number" }, value))));
  $("time").max = film.pictures.length - 1;
  $("who").replaceChildren(...scenario.hosts.map((host, k) => element("option", { value: k }, `${k}, on robot ${host}`)));
  drawQueue();
  drawSent();
  document.body.dataset.state = "done";
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return seek(film.pictures.length - 1);
  seek(0);
  play();
};

// ---- Time.
let timer;
const stopPlaying = () => {
  cancelAnimationFrame(timer);
  timer = undefined;
  $("play").textContent = "Play";
};
const play = () => {
  if (!film) return;
  const from = at.picture >= film.pictures.length - 1 ? 0 : at.picture;
  const begin = performance.now();
  const whole = 8000;
  $("play").textContent = "Pause";
  const frame = (now) => {
    const part = Math.max(0, now - begin) / whole;  // a frame may have begun before the button was pressed
    const picture = Math.min(film.pictures.length - 1, Math.floor(from + part * film.pictures.length));
    seek(picture, false);
    if (picture === film.pictures.length - 1) { stopPlaying(); showMoment(); return; }
    timer = requestAnimationFrame(frame);
  };
  timer = requestAnimationFrame(frame);
};
const seek = (picture, still = true) => {
  at = { picture, event: film.pictures[picture][1] };
  showTime(film.pictures[picture][0]);
  if (still) showMoment();
};
const showTime = (ns) => {
  $("time").value = at.picture;
  $("clock").value = exact(ns);
  $("time").setAttribute("aria-valuetext", exact(ns));
  drawMatrix();
  for (const chart of ["queue", "sent"]) {
    const line = $(chart).querySelector(".now");
    const x = 44 + (ns / film.end_ns) * 426;
    line?.setAttribute("x1", x);
    line?.setAttribute("x2", x);
  }
};

// ---- Who knows whom.
const drawMatrix = () => {
  const canvas = $("matrix");
  const size = scenario.hosts.length;
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(name).trim();
  const pen = canvas.getContext("2d");
  const margin = 34;
  const cell = (canvas.width - margin) / size;
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.font = `${Math.min(14, Math.max(9, cell * 0.6))}px sans-serif`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const every = Math.max(1, Math.ceil(16 / cell));
  let whole = 0, pairs = 0;
  for (let i = 0; i < size; ++i) {
    pen.globalAlpha = 1;
    pen.fillStyle = color("--soft");
    if (i % every === 0) {
      pen.fillText(i, margin / 2, margin + (i + 0.5) * cell);
      pen.fillText(i, margin + (i + 0.5) * cell, margin / 2);
    }
    for (let j = 0; j < size; ++j) {
      const known = film.known[(at.picture * size + i) * size + j];
      const [x, y] = [margin + j * cell, margin + i * cell];
      pen.globalAlpha = 1;
      pen.fillStyle = i === j ? color("--edge") : color("--panel");
      pen.fillRect(x, y, cell - 1, cell - 1);
      if (i === j) continue;
      const remote = scenario.hosts[i] !== scenario.hosts[j];
      pairs += remote;
      whole += remote && known === 255;
      pen.globalAlpha = (0.25 + 0.75 * (known / 255)) * (remote ? 1 : 0.5);
      pen.fillStyle = color(remote ? "--c0" : "--c4");
      // The part that is known, from below: lightness and height both say it.
      pen.fillRect(x, y + (cell - 1) * (1 - known / 255), cell - 1, (cell - 1) * (known / 255));
    }
  }
  pen.globalAlpha = 1;
  const words = !scenario.knows_pairs ? "A Discovery Server lives here, and clients may forget without a packet; pairs are not drawn."
    : `${whole} of ${pairs} pairs on different robots are complete at ${exact(film.pictures[at.picture][0])}`;
  canvas.setAttribute("aria-label", words);
};

// ---- Charts over time.
const axes = (svg, largest, end, unit = "") => {
  svg.replaceChildren();
  for (const part of [0, 0.5, 1]) {
    const y = 190 - part * 175;
    svg.append(drawn("line", { x1: 44, x2: 470, y1: y, y2: y, class: "axis" }),
      drawn("text", { x: 40, y: y + 4, "text-anchor": "end" }, short(largest * part) + unit));
  }
  for (const part of [0, 0.5, 1]) {
    svg.append(drawn("text", { x: 44 + part * 426, y: 210, "text-anchor": ["start", "middle", "end"][part * 2] },
      rough(end * part)));
  }
};
const short = (value) => (value >= 1e6 ? `${+(value / 1e6).toPrecision(3)}M` : value >= 1e4 ? `${+(value / 1e3).toPrecision(3)}k`
  : `${+value.toPrecision(3)}`);
const nowLine = (svg) => svg.append(drawn("line", { x1: 44, x2: 44, y1: 10, y2: 190, class: "now" }));
const xOf = (picture) => 44 + (picture[0] / film.end_ns) * 426;

const drawQueue = () => {
  const svg = $("queue");
  const largest = Math.max(1, ...film.pictures.map((p) => Math.max(p[3], p[4])));
  axes(svg, largest, film.end_ns);
  const lines = [[3, "--c0", "for the channel", ""], [4, "--c1", "for send buffers (dashed)", "5 3"]];
  for (const [column, color, , dash] of lines) {
    const line = film.pictures.map((p) => `${xOf(p).toFixed(1)},${(190 - (p[column] / largest) * 175).toFixed(1)}`);
    svg.append(drawn("polyline", { points: line.join(" "), fill: "none", stroke: `var(${color})`, "stroke-width": 2,
      "stroke-dasharray": dash }));
  }
  nowLine(svg);
  const most = (column) => many(Math.max(...film.pictures.map((p) => p[column])));
  $("queues").replaceChildren(...lines.map(([column, color, name]) => element("li", {},
    element("i", { style: `background: var(${color})` }), `${name}, at most ${most(column)}`)));
  svg.setAttribute("aria-label", `At most ${most(3)} fragments wait for the channel, ${most(4)} packets for send buffers`);
};

const drawSent = () => {
  const svg = $("sent");
  const last = film.pictures.at(-1)[5];
  const largest = Math.max(1, last.reduce((a, b) => a + b, 0));
  axes(svg, largest, film.end_ns);
  const floor = film.pictures.map(() => 0);
  constants.classes.forEach((name, k) => {
    if (last[k] === 0) return;
    const y = (value) => (190 - (value / largest) * 175).toFixed(1);
    const under = film.pictures.map((p, n) => `${xOf(p).toFixed(1)},${y(floor[n])}`);
    film.pictures.forEach((p, n) => { floor[n] += p[5][k]; });
    const over = film.pictures.map((p, n) => `${xOf(p).toFixed(1)},${y(floor[n])}`);
    svg.append(drawn("polygon", { points: [...over, ...under.reverse()].join(" "), fill: `var(--c${k})`,
      stroke: "var(--page)", "stroke-width": 0.7 }));
  });
  nowLine(svg);
  $("legend").replaceChildren(...constants.classes.flatMap((name, k) => (last[k] === 0 ? []
    : [element("li", {}, element("i", { style: `background: var(--c${k})` }), `${name} ${many(last[k])}`)])));
  svg.setAttribute("aria-label", constants.classes.map((name, k) => `${name} ${last[k]}`).join(", "));
};

// ---- Other seeds.
let samples = [];
const sample = async (mine) => {
  samples = [];
  sampler.restart();
  drawSeeds();
  const wanted = scenario.is_drawn ? Number($("samples").value) : 1;
  try {
    await sampler.call("open", $("yaml").value);
    for (let seed = 0; seed < wanted && mine === generation; ++seed) {
      const one = await sampler.call("sample", seed);
      if (mine !== generation) return;
      samples.push(one);
      drawSeeds(wanted);
    }
    document.body.dataset.samples = "done";
  } catch (failure) {
    if (failure.message !== "given up") $("quantiles").textContent = failure.message;
  }
};
const drawSeeds = (wanted = 1) => {
  const svg = $("seeds");
  const ended = samples.filter((one) => one.t_disc_ns !== null).sort((a, b) => a.t_disc_ns - b.t_disc_ns);
  const end = Math.max(1e6, ...samples.map((one) => one.t_disc_ns ?? one.end_ns)) * 1.05;
  axes(svg, wanted, end);
  const colors = { storm: "--bad", incomplete: "--bad", fine: "--good" };
  const dot = (one, k) => {
    const [x, y] = [44 + ((one.t_disc_ns ?? one.end_ns) / end) * 426, 190 - ((k + 1) / wanted) * 175];
    const color = `var(${colors[one.health.name] || "--warn"})`;
    const mark = one.health.name === "fine" ? drawn("circle", { cx: x, cy: y, r: 3.5, fill: color })
      : drawn("path", { d: one.t_disc_ns === null ? `M${x - 4} ${y - 4}l8 8m0-8l-8 8` : `M${x} ${y - 4}l4.5 8h-9z`,
        fill: one.t_disc_ns === null ? "none" : color, stroke: color });
    mark.append(drawn("title", {}, `seed ${one.seed}: ${one.health.headline}, ${exact(one.t_disc_ns ?? one.end_ns)}`));
    svg.append(mark);
  };
  ended.forEach(dot);
  samples.filter((one) => one.t_disc_ns === null).forEach((one, k) => dot(one, ended.length + k));
  const storms = samples.filter((one) => one.health.name === "storm").length;
  $("quantiles").textContent = samples.length === 0 ? "" : `${samples.length} of ${wanted}: ${storms} storms (triangles), `
    + `${samples.length - ended.length} not complete (crosses)`
    + (ended.length ? `; median ${rough(ended[Math.floor((ended.length - 1) / 2)].t_disc_ns)}` : "");
  svg.setAttribute("aria-label", $("quantiles").textContent);
};

// ---- One event.
let asked = false, again = false;
const showMoment = async () => {
  if (asked) { again = true; return; }  // the newest wish counts
  asked = true;
  const mine = generation;
  try {
    const moment = await runner.call("moment", at.event, Number($("who").value) || 0);
    if (mine === generation && !again) describe(moment);
  } catch (failure) {
    if (mine === generation) complain("engine", failure.message);
  } finally {
    asked = false;
    if (again) { again = false; showMoment(); }
  }
};

/// Which pages of the guide state the rules of an implementation; the first one that has a rule counts.
const pagesOf = () => (scenario.has_server ? ["discovery-server", "fastdds"]
  : { paper: ["model", "museum"], fastdds: ["fastdds"], cyclone: ["cyclone", "cyclone-life"] }[scenario.implementation] ?? []);
/// The rule of an effect, as a link to where the guide states it.
const ruleLink = (effect) => {
  const rule = effect.replace(/\.\d+$/, "");
  const pages = guide[rule] ?? {};
  const page = pagesOf().find((name) => name in pages) ?? Object.keys(pages)[0];
  const where = pages[page];
  if (!where) return element("code", {}, effect);
  return element("a", { href: where }, element("code", {}, effect));
};

const describe = (moment) => {
  const steps = [...moment.steps].sort((a, b) => b.mine - a.mine);
  const shown = steps.slice(0, 24);
  const list = (items, most = 12) => {
    const made = element("ul", {}, ...items.slice(0, most).map((item) => element("li", {}, item)));
    if (items.length > most) made.append(element("li", { className: "soft" }, `and ${items.length - most} more`));
    return made;
  };
  const rules = element("p", {}, moment.effects.length ? "By the rules " : "No rule has an effect in it.");
  moment.effects.slice(-16).forEach((effect) => rules.append(ruleLink(effect), " "));
  $("what").replaceChildren(
    element("p", { className: "when" }, `Event ${many(moment.event)} of ${many(film.events)}, at ${exact(moment.time_ns)}: ${moment.what}`),
    rules, list(moment.packets),
    steps.length === 0 ? "" : element("div", { className: "scroll" }, element("table", {},
      element("caption", {}, steps.length > shown.length ? `The first ${shown.length} of ${steps.length} steps`
        : "Steps of machines; those of the participant in bold"),
      element("tbody", {}, ...shown.map((step) => element("tr", { className: step.mine ? "mine" : "" },
        element("td", {}, step.machine), element("td", {}, step.of), element("td", {}, step.event),
        element("td", {}, `${step.before} → ${step.after}`),
        element("td", { className: "number" }, step.descriptors ? `${step.descriptors} descriptors` : "")))))));
  showReaders(moment);
  showMachine(moment);
  document.body.dataset.moment = moment.event;
};

const showReaders = (moment) => {
  if (moment.readers.length === 0) {
    $("states").textContent = "No descriptor has moved yet, or this library has no such states.";
    $("readers").replaceChildren();
    return;
  }
  const states = constants.machines[moment.descriptor_machine].states;
  $("states").textContent = states.map((state) => `${state} ${constants.state_words[state] || ""}`.trim()).join(", ");
  const color = (k) => `var(--c${[4, 1, 3, 6, 5, 0][k + (states.length === 5 ? 1 : 0)]})`;
  $("readers").replaceChildren(element("table", {},
    element("thead", {}, element("tr", {}, ...["reader", "stream", "", ...states].map((head, k) =>
      element("th", { className: k > 2 ? "number" : "" }, head)))),
    element("tbody", {}, ...moment.readers.map((row) => {
      const sum = row.counts.reduce((a, b) => a + b, 0) || 1;
      return element("tr", {}, element("td", {}, String(row.reader)), element("td", {}, ["pub", "sub"][row.stream]),
        element("td", {}, element("span", { className: "bar" }, ...row.counts.map((count, k) =>
          element("span", { style: `width: ${(100 * count) / sum}%; background: ${color(k)}`, title: `${states[k]} ${count}` })))),
        ...row.counts.map((count) => element("td", { className: `number${count ? "" : " none"}` }, String(count))));
    }))));
};

const showMachine = (moment) => {
  const found = {};  // machine → state → how many
  const add = (machine, state, count) => {
    found[machine] ??= {};
    found[machine][state] = (found[machine][state] || 0) + count;
  };
  for (const one of moment.machines) add(one.machine, one.state, 1);
  for (const row of moment.readers) {
    row.counts.forEach((count, k) => count && add(moment.descriptor_machine, constants.machines[moment.descriptor_machine].states[k], count));
  }
  const names = Object.keys(found).filter((name) => name in constants.machines);
  const chosen = names.includes($("machine").value) ? $("machine").value
    : names.includes(moment.descriptor_machine) ? moment.descriptor_machine : names[0];
  $("machine").replaceChildren(...names.map((name) => element("option", {}, name)));
  if (!chosen) { $("drawing").replaceChildren(); return; }
  $("machine").value = chosen;
  const holder = element("div");
  const root = holder.attachShadow({ mode: "open" });  // drawings have style sheets of their own
  root.innerHTML = `<style>svg { max-width: 100%; min-width: 46rem; height: auto } .active { stroke-width: 4 !important; fill: var(--info-fill) !important }
    .many { fill: var(--packet); font-weight: 600 }</style>${constants.machines[chosen].svg}`;
  for (const box of root.querySelectorAll("rect.state")) {
    const name = [...root.querySelectorAll("text.bold")].find((text) => {
      const inside = (key, size) => +text.getAttribute(key) >= +box.getAttribute(key)
        && +text.getAttribute(key) <= +box.getAttribute(key) + +box.getAttribute(size);
      return inside("x", "width") && inside("y", "height");
    });
    const count = found[chosen][name?.textContent];
    if (!count) continue;
    box.classList.add("active");
    root.querySelector("svg").append(drawn("text", { x: +box.getAttribute("x") + 8, y: +box.getAttribute("y") + 16, class: "many" }, String(count)));
  }
  $("drawing").replaceChildren(holder);
};

const stepEvent = (by) => {
  if (!film) return;
  stopPlaying();
  moveTo(Math.min(film.events, Math.max(0, at.event + by)));
};
const stepOwn = async (forward) => {
  if (!film) return;
  stopPlaying();
  const found = await runner.call("step", at.event, Number($("who").value), forward ? 1 : 0);
  if (found > 0) moveTo(found);
};
const moveTo = (event) => {
  const next = film.pictures.findIndex((p) => p[1] >= event);
  at = { picture: next < 0 ? film.pictures.length - 1 : next, event };
  showTime(film.pictures[at.picture][0]);
  showMoment();
};

// ---- Controls.
const options = (id, list) => $(id).replaceChildren(...list.map(([value, words]) => element("option", { value }, words)));
options("dds", library.dds);
options("wireless", library.wireless);
options("buffer", [["0", "as the system has it, 208 KiB"], ["65536", "64 KiB"], ["1000000", "1 MB"], ["4000000", "4 MB"]]);
$("preset").replaceChildren(element("option", { value: "" }, "what the controls say"),
  ...["scenario", "exhibit"].map((kind) => element("optgroup", { label: kind === "scenario" ? "Scenarios" : "The museum" },
    ...Object.entries(library[`${kind}s`]).map(([name, one]) => element("option", { value: `${kind}=${name}` }, one.title)))));

let waiting;
$("knobs").addEventListener("input", () => {
  $("yaml").value = yamlOfKnobs();
  $("preset").value = "";
  showKnobs();
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    writeAddress(new URLSearchParams(knobs.map((name) => [name, $(name).value])));
    runner.restart();
    run();
  }, 250);
});
$("preset").addEventListener("change", () => {
  writeAddress($("preset").value);
  runner.restart();
  readAddress();
});
$("apply").addEventListener("click", () => {
  $("preset").value = "";
  showKnobs();
  writeAddress(new URLSearchParams({ yaml: $("yaml").value }));
  runner.restart();
  run();
});
$("copy").addEventListener("click", () => { $("yaml").select(); navigator.clipboard?.writeText($("yaml").value); });
$("stop").addEventListener("click", () => {
  ++generation;
  runner.restart();
  sampler.restart();
  $("stop").hidden = true;
  complain("stopped", "the simulation was stopped before its end");
});
$("samples").addEventListener("change", () => film && sample(generation));
$("play").addEventListener("click", () => (timer === undefined ? play() : (stopPlaying(), showMoment())));
$("time").addEventListener("input", () => { if (film) { stopPlaying(); seek(Number($("time").value)); } });
$("who").addEventListener("change", showMoment);
$("machine").addEventListener("change", showMoment);
$("back").addEventListener("click", () => stepEvent(-1));
$("on").addEventListener("click", () => stepEvent(1));
$("back-own").addEventListener("click", () => stepOwn(false));
$("on-own").addEventListener("click", () => stepOwn(true));
addEventListener("keydown", (key) => {
  const own = key.key === " " ? "input, select, textarea, button, summary, a" : "input, select, textarea";
  if (key.ctrlKey || key.altKey || key.metaKey || key.target.closest(own)) return;
  if (key.key === "ArrowRight" || key.key === "ArrowLeft") {
    const forward = key.key === "ArrowRight";
    key.shiftKey ? stepOwn(forward) : stepEvent(forward ? 1 : -1);
  } else if (key.key === " ") {
    $("play").click();
  } else {
    return;
  }
  key.preventDefault();
});
addEventListener("hashchange", () => { runner.restart(); readAddress(); });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => film && drawMatrix());
readAddress();
