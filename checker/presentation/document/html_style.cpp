// The style sheet of the pages: screen in two colour schemes, narrow screens, paper. Verdicts have
// a colour, a sign and a word, never a colour alone.
#include "checker/presentation/document/html_page.hpp"

namespace stormproof::report {

namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light; --page: #ffffff; --text: #1c2430; --soft: #56616d; --edge: #d0d7de;
  --panel: #f4f6f8; --accent: #1a56ae; --good: #176039; --good-fill: #dcf3e6; --bad: #a80d26;
  --bad-fill: #fbe3e7; --warn: #7d4400; --warn-fill: #fdf0da; --info: #1a56ae;
  --info-fill: #e3edfb; --now: #ffd84d; }
@media screen and (prefers-color-scheme: dark) {
  :root:not([data-theme="light"]) { color-scheme: dark; --page: #14181d; --text: #e4e8ec;
    --soft: #a0abb6; --edge: #3d4650; --panel: #1d232a; --accent: #86b5ff; --good: #7ad8a6;
    --good-fill: #173527; --bad: #ff8d9d; --bad-fill: #43161f; --warn: #ffbe78;
    --warn-fill: #3d2a12; --info: #86b5ff; --info-fill: #1b2f4d; --now: #a88600; } }
@media screen { :root[data-theme="dark"] { color-scheme: dark; --page: #14181d; --text: #e4e8ec;
    --soft: #a0abb6; --edge: #3d4650; --panel: #1d232a; --accent: #86b5ff; --good: #7ad8a6;
    --good-fill: #173527; --bad: #ff8d9d; --bad-fill: #43161f; --warn: #ffbe78;
    --warn-fill: #3d2a12; --info: #86b5ff; --info-fill: #1b2f4d; --now: #a88600; } }
* { box-sizing: border-box; }
body { background: var(--page); color: var(--text); margin: 0;
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1600px; margin: 0 auto; padding: 1.2rem 1.2rem 4rem; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: .4rem 9rem .8rem 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .6rem; border-bottom: 1px solid var(--edge);
  padding-bottom: .3rem; }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .4rem; overflow-wrap: anywhere; }
p, li { max-width: 85ch; overflow-wrap: anywhere; } p { margin: .5rem 0; }
ul { margin: .4rem 0; padding-left: 1.4rem; }
a { color: var(--accent); }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
  font-size: 13px; }
pre { background: var(--panel); border: 1px solid var(--edge); border-radius: 6px;
  padding: .7rem .9rem; overflow-x: auto; margin: .5rem 0; }
.soft { color: var(--soft); }
#theme { position: absolute; top: 1.2rem; right: 1.2rem; }
.heads { position: absolute; }
button { font: inherit; font-size: 14px; color: var(--text); background: var(--panel);
  border: 1px solid var(--soft); border-radius: 6px; padding: .25rem .7rem; cursor: pointer; }
button:hover:not([aria-disabled="true"]) { border-color: var(--accent); color: var(--accent); }
button[aria-disabled="true"] { color: var(--soft); opacity: .6; cursor: default; }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; border-radius: 4px; }
.banner { border: 1px solid; border-left-width: 8px; border-radius: 8px; padding: .7rem 1rem;
  margin: .8rem 0; }
.banner p { margin: .2rem 0; } .banner .verdict-line { font-size: 1.15rem; font-weight: 650; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); }
.info { color: var(--info); }
.banner.good, .badge.good { background: var(--good-fill); border-color: var(--good); }
.banner.bad, .badge.bad { background: var(--bad-fill); border-color: var(--bad); }
.banner.warn, .badge.warn { background: var(--warn-fill); border-color: var(--warn); }
.banner.info, .badge.info { background: var(--info-fill); border-color: var(--info); }
.banner > :not(.verdict-line) { color: var(--text); }
.note { border-left: 4px solid; padding-left: .6rem; }
.badge { display: inline-block; border: 1px solid; border-radius: 1rem; padding: 0 .6rem;
  font-size: 13px; font-weight: 600; white-space: nowrap; }
.counts { display: flex; flex-wrap: wrap; gap: .5rem; padding: 0; margin: .8rem 0;
  list-style: none; }
.counts .badge { font-size: 15px; padding: .15rem .8rem; }
.scroll { overflow: auto; }
table { border-collapse: collapse; font-size: 14px; margin: .6rem 0; }
th, td { padding: .3rem .6rem; text-align: left; vertical-align: top;
  border-bottom: 1px solid var(--edge); }
th { color: var(--soft); font-weight: 600; }
td { overflow-wrap: break-word; min-width: 4.5rem; max-width: 60ch; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td.tight { white-space: nowrap; }
tr.different td { background: var(--panel); }
table.wide { width: 100%; }
.dense th, .dense td { padding: .3rem .35rem; min-width: 3.2rem; } .dense .badge { padding: 0 .35rem; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; }
.facts { display: grid; grid-template-columns: max-content 1fr; gap: .15rem .9rem; margin: .5rem 0; }
.facts dt { color: var(--soft); } .facts dd { margin: 0; overflow-wrap: anywhere; }
details { margin: .4rem 0; }
summary { cursor: pointer; color: var(--accent); padding: .1rem 0; }
td details { margin: .15rem 0; font-size: 13px; }
.plots { display: grid; gap: 12px; margin: .8rem 0; align-items: start;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 520px), 1fr)); }
.plots > svg, .drawing > svg { display: block; height: auto; }
.plots > svg:only-child { grid-column: 1 / -1; }
.plots > svg { width: 100%; max-width: min(100%, calc(1.36 * var(--natural)));
  border: 1px solid var(--edge); border-radius: 6px; }
.drawing { width: fit-content; max-width: 100%; }
.drawing > svg { width: var(--natural); max-width: 100%; min-width: calc(.65 * var(--natural)); }
figure { margin: .6rem 0; }
figcaption { color: var(--soft); font-size: 14px; margin-bottom: .3rem; }
.drawing { border: 1px solid var(--edge); border-radius: 6px; background: var(--page); }
.js .walk .drawing { max-height: 78vh; }
.walk { display: grid; gap: .8rem; grid-template-columns: minmax(0, 1fr); }
.stepper { border: 1px solid var(--edge); border-radius: 8px; background: var(--panel);
  padding: .6rem .9rem; align-self: start; }
.js .stepper { position: sticky; bottom: 0; max-height: 46vh; overflow: auto; z-index: 1; }
@media (min-width: 1500px) { main.broad { max-width: 1800px; }
  .walk { grid-template-columns: minmax(0, 1fr) 30rem; }
  .js .stepper { top: 1rem; bottom: auto; max-height: 92vh; } }
.controls { display: flex; flex-wrap: wrap; gap: .4rem; align-items: center; }
.controls input { flex: 1 1 9rem; min-width: 7rem; accent-color: var(--accent); }
.controls output { font-variant-numeric: tabular-nums; white-space: nowrap; }
.keys { font-size: 13px; margin: .3rem 0 0; }
kbd { border: 1px solid var(--soft); border-radius: 4px; padding: 0 .3rem; font-size: 12px; }
.steps { padding-left: 1.6rem; margin: .5rem 0 0; }
.js .steps { list-style: none; padding: 0; }
.js .steps > li:not(.current) { display: none; }
.steps > li { max-width: none; }
.when { font-weight: 600; margin: 0; }
.acts { margin: .2rem 0; } .acts li.violated { color: var(--bad); font-weight: 600; }
.steps table { font-size: 13px; margin: .2rem 0; } .steps th, .steps td { padding: .1rem .5rem; }
.steps tr.moved td { font-weight: 600; }
.steps tr.moved td:last-child::after { content: " ← changed"; color: var(--info);
  font-weight: 400; }
.art .row.current { fill: var(--now); fill-opacity: .4; stroke: var(--accent); }
.art .current:not(.row) { stroke-width: 2.6; }
.art .state.active { fill: var(--info-fill); stroke: var(--accent); stroke-width: 4; }
.unseen { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%);
  white-space: nowrap; }
[hidden] { display: none !important; }
@media (max-width: 640px) { main { padding: .8rem .7rem 3rem; } h1 { margin-right: 0; }
  #theme { position: static; margin: .7rem .7rem 0; }
  .facts { grid-template-columns: 1fr; gap: 0; } .facts dd { margin: 0 0 .3rem; }
  table.cards thead { display: none; } td.tight { white-space: normal; overflow-wrap: anywhere; }
  table.cards tr { display: block; border-bottom: 1px solid var(--edge); padding: .4rem 0; }
  table.cards, table.cards tbody, table.cards caption { display: block; }
  table.cards td { display: block; border: 0; padding: .1rem 0; max-width: none; }
  table.cards td:empty { display: none; } table.cards td.number { text-align: left; }
  table.cards td[data-head]::before { content: attr(data-head) ": "; color: var(--soft); } }
@media (prefers-reduced-motion: no-preference) { .js .drawing { scroll-behavior: smooth; } }
@page { margin: 14mm; }
@media print { body { font-size: 12px; } main { max-width: none; padding: 0; }
  #theme, .controls, .keys, .steps, .js .stepper { display: none; }
  details::details-content { content-visibility: visible; display: block; height: auto; }
  summary { color: var(--text); list-style: none; }
  .js .walk .drawing, .drawing, .scroll { max-height: none; overflow: visible; }
  .drawing > svg, .plots > svg { max-width: 100%; min-width: 0; max-height: 255mm; width: auto;
    height: auto; }
  figure, .banner, table:not(.stacked) tr, .plots > svg { break-inside: avoid; }
  h2, h3, figcaption { break-after: avoid; }
  table.stacked thead { display: none; }
  table.stacked tr { display: block; border-bottom: 1px solid var(--edge); padding: 2mm 0; }
  table.stacked td { display: block; border: 0; padding: 0; max-width: none; }
  p, li { max-width: none; } .walk { display: block; } pre { white-space: pre-wrap; overflow-wrap: anywhere; }
  .badge, .banner { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";

}  // namespace

std::string_view page_style() { return style; }

}  // namespace stormproof::report
