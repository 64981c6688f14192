// Packs the page that simulates: one file, play.html, which needs nothing else, and storm.js, a storm that moves, for the
// start page of the site. Run by the target `play` (cmake/Play.cmake) after the engine has been compiled.
//
// usage: node pack.mjs --source DIR --engine DIR --output DIR [--guide PREFIX]
//   --engine  where play.js and play.wasm are
//   --guide   what stands before "specs/guide/…" in links to the guide; without it rules are not linked
import { createRequire } from "node:module";
import { gzipSync } from "node:zlib";
import { readFileSync, readdirSync, writeFileSync, mkdirSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { parseArgs } from "node:util";

const given = parseArgs({ options: Object.fromEntries(["source", "engine", "output", "guide"].map((name) =>
  [name, { type: "string" }])) }).values;
const source = resolve(given.source);
const play = join(source, "specs/site/play");
const text = (...path) => readFileSync(join(...path), "utf8");
const names = (folder) => readdirSync(join(source, folder)).filter((file) => file.endsWith(".yaml")).sort()
  .map((file) => basename(file, ".yaml"));

// ---- What the engine says of itself.
const module = readFileSync(join(given.engine, "play.wasm"));
const engine = await createRequire(import.meta.url)(resolve(given.engine, "play.js"))({ wasmBinary: module });
const call = (name, ...args) => JSON.parse(engine.ccall(name, "string", args.map((one) => (typeof one === "string" ? "string" : "number")), args));
const constants = call("page_constants");
const { style } = constants;
delete constants.style;

// ---- What is shipped: scenarios, exhibits, profiles.
const value = (yaml, key) => yaml.match(new RegExp(`^${key}: *(.*)$`, "m"))?.[1] ?? "";
const scenarios = Object.fromEntries(names("specs/scenarios").map((name) => {
  const yaml = text(source, "specs/scenarios", `${name}.yaml`);
  return [name, { title: name, yaml: yaml.replace(/^# yaml-language-server.*\n(#\n)?/, "") }];
}));
const exhibits = Object.fromEntries(names("specs/museum").map((name) => {
  const yaml = text(source, "specs/museum", `${name}.yaml`);
  const own = yaml.slice(yaml.search(/^scenario:$/m)).split("\n").slice(1);
  const end = own.findIndex((line) => /^[^\s#]/.test(line));
  const lines = (end < 0 ? own : own.slice(0, end)).map((line) => line.replace(/^ {2}/, ""));
  return [name, { title: `${name}: ${value(yaml, "title")}`, yaml: `${lines.join("\n").trimEnd()}\n` }];
}));
const distributions = text(source, "specs/distributions.yaml").matchAll(/^ {2}(\w+):\n {4}ships: .*\n {4}profile: (\S+)/gm);
const runsOn = {};
for (const [, name, profile] of distributions) (runsOn[profile] ??= []).push(name);
const profiles = (folder) => names(folder).map((name) => {
  const words = value(text(source, folder, `${name}.yaml`), "description");
  return [name, `${name}${runsOn[name] ? ` (ROS 2 ${runsOn[name].join(", ")})` : ""}: ${words}`];
});
const first = (list, name) => [...list.filter((one) => one[0] === name), ...list.filter((one) => one[0] !== name)];
const library = { scenarios, exhibits, dds: first(profiles("specs/dds"), "fastdds-2.6.11"),
  wireless: first(profiles("specs/wireless"), "wifi-80211n-paper") };

// ---- Where the guide states a rule: the heading above it, by the page's ids of headings.
const slug = (heading) => heading.replace(/`/g, "").normalize("NFKD").replace(/[^\w\s-]/g, "").trim().toLowerCase().replace(/[-\s]+/g, "-");
const guide = {};
if (given.guide !== undefined) {
  for (const page of ["model", "fastdds", "discovery-server", "cyclone", "cyclone-life", "wifi", "museum"]) {
    let anchor = "";
    for (const line of text(source, "specs/guide", `${page}.md`).split("\n")) {
      const heading = line.match(/^##+ (.*)$/);
      if (heading) anchor = `#${slug(heading[1])}`;
      for (const [, rule] of line.matchAll(/`§([A-Z]\w*(?: [A-Z]\w*)?)/g)) {
        ((guide[rule] ??= {})[page]) ??= `${given.guide}specs/guide/${page}.html${anchor}`;
      }
    }
  }
}

// ---- The page.
const script = (body) => body.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString("base64");
const data = Object.entries({ constants, library, guide }).map(([name, json]) => `const ${name} = ${JSON.stringify(json)};`).join("\n");
const worker = `${text(given.engine, "play.js")}\n${text(play, "worker.js")}`;
const parts = {
  "/*STYLE*/": style + text(play, "page.css"),
  "/*ENGINE*/": packed(worker),
  "/*MODULE*/": packed(module),
  "/*DATA*/": script(data),
  "/*SCRIPT*/": script(text(play, "page.js")),
};
let page = text(play, "page.html");
if (given.guide === undefined) page = page.replace(/\n<a class="guide".*<\/a>/, "");
for (const [place, content] of Object.entries(parts)) page = page.split(place).join(content);
mkdirSync(given.output, { recursive: true });
writeFileSync(join(given.output, "play.html"), page);

// ---- The storm of the start page: few pictures of the run that the README begins with.
const opened = call("page_open", scenarios["wifi-5x20-fastdds"].yaml);
if (opened.error) throw new Error(`${opened.error.where}: ${opened.error.what}`);
const run = call("page_record", 120);
const at = engine.ccall("page_known", "number", [], []);
const storm = { hosts: opened.hosts, end: run.end_ns, headline: run.health.headline, sentence: run.health.sentence,
  pictures: run.pictures.map(([time, , , waiting, backlog]) => [time, waiting, backlog]),
  known: Buffer.from(engine.HEAPU8.slice(at, at + engine.ccall("page_known_bytes", "number", [], []))).toString("base64") };
writeFileSync(join(given.output, "storm.js"), `const storm = ${JSON.stringify(storm)};\n${text(play, "storm.js")}`);
console.log(`play: ${join(given.output, "play.html")}, ${Math.round(page.length / 1000)} kB`);
