// The style sheet of the page: light and dark, paper, narrow screens.

#include "eval/report_page_sections.h"

namespace panache {

std::string page_look() {
  return R"(
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1d2126; --soft: #5c6570;
  --line: #d9dee4; --faint: #f3f5f7; --accent: #0065a3; --bar: #d9e9f5; --warn: #8a3b00; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14171a; --ink: #e4e8ec; --soft: #9aa5b1; --line: #333a42; --faint: #1c2126;
    --accent: #6db8ee; --bar: #1e3c53; --warn: #ffb27a; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; scroll-padding-top: 1rem; }
body { margin: 0 auto; max-width: 80rem; padding: 2.5rem clamp(1rem, 4vw, 3rem) 4rem;
  background: var(--ground); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif; }
h1 { font-size: 2rem; line-height: 1.15; letter-spacing: -0.02em; margin: 0 0 .4rem; }
h2 { font-size: 1.35rem; line-height: 1.25; letter-spacing: -0.01em; margin: 3.2rem 0 .4rem;
  padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.8rem 0 .3rem; }
p { max-width: 44rem; text-wrap: pretty; margin: .3rem 0 1rem; color: var(--soft); }
p.warning { color: var(--warn); font-weight: 600; border-left: 4px solid; padding-left: .8rem; }
a { color: var(--accent); text-underline-offset: .15em; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: 1.2rem 0 0; }
dl { margin: .8rem 0; display: grid; gap: .35rem 1.5rem;
  grid-template-columns: minmax(10rem, max-content) minmax(0, 1fr); }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; max-width: 52rem; }
.definitions dt { color: var(--ink); font-weight: 600; max-width: 15rem; }
.table { overflow-x: auto; margin: .8rem 0 1.2rem; max-width: 100%; }
table { border-collapse: collapse; font-size: .8125rem; line-height: 1.3;
  font-variant-numeric: tabular-nums lining-nums; }
caption { text-align: left; color: var(--soft); padding: 0 0 .4rem; }
th, td { padding: .34rem .5rem; text-align: right; vertical-align: baseline; }
td { white-space: nowrap; }
thead th { color: var(--soft); font-weight: 600; vertical-align: bottom; max-width: 8rem;
  border-bottom: 1px solid var(--line); }
thead th.group { text-align: left; color: var(--ink); border-bottom: 0; padding-bottom: 0;
  max-width: none; white-space: nowrap; }
th:first-child:not(.first) { text-align: left; }
tbody th { font-weight: 500; white-space: nowrap;
  position: sticky; left: 0; background: var(--ground); z-index: 1; }
tbody th.long { white-space: normal; min-width: 16rem; overflow-wrap: anywhere; }
tbody tr:nth-child(even) > * { background-color: var(--faint); }
tbody tr.apart > * { border-top: 1px solid var(--soft); }
.first { border-left: 1px solid var(--line); }
table tr > :nth-child(2).first { border-left: 0; }
td.share { background-image: linear-gradient(var(--bar), var(--bar)); background-repeat: no-repeat;
  background-position: left bottom; background-size: var(--share) 3px; }
td b { color: var(--accent); font-weight: 700; }
figure { margin: .8rem 0 1.4rem; overflow-x: auto; }
svg { display: block; font-family: inherit; }
figure.plot svg { max-width: 100%; height: auto; min-width: 34rem; }
.plots { display: grid; gap: 0 1.5rem;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 34rem), 1fr)); }
.plots figure { margin: .4rem 0; }
details { margin: .4rem 0; }
summary { cursor: pointer; color: var(--accent); padding: .15rem 0; }
@media screen and (prefers-color-scheme: dark) {
  svg { filter: invert(.915) hue-rotate(180deg); } }
@media (max-width: 40rem) {
  body { padding-top: 1.4rem; }
  h1 { font-size: 1.6rem; }
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: .7rem; }
  tbody th, tbody th.long { white-space: normal; min-width: 7rem; max-width: 9rem;
    overflow-wrap: anywhere; }
  th, td { padding: .34rem .5rem; } }
@page { margin: 12mm; }
@media print {
  :root { --ground: #ffffff; --ink: #000000; --soft: #444444; --line: #bbbbbb; --faint: #f5f5f5;
    --accent: #00486f; --bar: #c8dcea; --warn: #7a3300; }
  body { padding: 0; max-width: none; font-size: 10pt; }
  nav { display: none; }
  h2, h3 { break-after: avoid; }
  tr, figure { break-inside: avoid; }
  .table, figure { overflow: visible; }
  table { font-size: 6.5pt; }
  th, td { padding: 1.5pt 2pt; }
  tbody th, tbody th.long { position: static; min-width: 0; }
  figure.plot svg { min-width: 0; }
  svg { max-width: 100%; height: auto; } }
)";
}

}  // namespace panache
