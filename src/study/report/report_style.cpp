#include "study/report/report_assets.h"

namespace grid_path_planner::study {

const char* const kReportStyle = R"css(
:root { --ink: #1c2127; --soft: #57606a; --line: #d0d7de; --paper: #ffffff; --tint: #f3f6f9; --link: #0a558c; }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); background: var(--paper); font: 16px/1.5 system-ui, sans-serif; }
main, header, nav { max-width: 62rem; margin: 0 auto; padding: 0 1rem; }
header { padding-top: 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .25rem; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 .5rem; }
p { margin: .4rem 0; }
.soft, figcaption, caption { color: var(--soft); font-size: .9rem; }
a { color: var(--link); }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1rem; padding: .5rem 0; margin: 0; list-style: none; }
.facts { display: flex; flex-wrap: wrap; gap: .5rem; padding: 0; margin: 1rem 0; list-style: none; }
.facts li { background: var(--tint); border: 1px solid var(--line); border-radius: .4rem; padding: .3rem .8rem; }
.facts b { font-size: 1.15rem; }
.failure { border-left: .3rem solid #D55E00; padding-left: .8rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding: .3rem 0; }
th, td { padding: .25rem .6rem; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
td.number, th.number { text-align: right; }
#table-verdicts td { white-space: normal; }
thead th { position: sticky; top: 0; background: var(--tint); padding: 0; }
th button { all: unset; display: block; width: 100%; padding: .35rem .6rem; cursor: pointer; font-weight: 600; box-sizing: border-box; }
th button::after { content: " \2195"; color: var(--soft); }
th[aria-sort=ascending] button::after { content: " \2191"; color: var(--ink); }
th[aria-sort=descending] button::after { content: " \2193"; color: var(--ink); }
button:focus-visible, input:focus-visible, select:focus-visible, a:focus-visible, summary:focus-visible { outline: 3px solid #0072B2; outline-offset: 1px; }
tbody tr:hover { background: var(--tint); }
.tall { max-height: 34rem; overflow: auto; border: 1px solid var(--line); }
figure { margin: 1rem 0; }
svg { width: 100%; height: auto; font: 12px system-ui, sans-serif; fill: var(--ink); display: block; }
.chart { min-width: 34rem; }
.chart-title { font-weight: 600; font-size: 14px; }
.grid { stroke: #dde3e8; }
.median { stroke: #000; stroke-width: 2.5; }
fieldset { border: 1px solid var(--line); border-radius: .4rem; margin: .5rem 0; padding: .4rem .8rem; display: flex; flex-wrap: wrap; gap: .2rem 1rem; }
legend { font-weight: 600; font-size: .9rem; }
label { display: inline-flex; align-items: center; gap: .35rem; min-height: 2rem; }
.swatch { width: 2.2rem; height: .8rem; flex: none; }
#map { border: 1px solid var(--line); max-width: 46rem; }
#map image { image-rendering: pixelated; }
#results { font-size: .9rem; padding-left: 1.2rem; }
select { font: inherit; padding: .2rem; max-width: 100%; }
code { font: .82rem/1.4 ui-monospace, monospace; overflow-wrap: anywhere; background: var(--tint); padding: .05rem .25rem; }
details { margin: .5rem 0; }
@media print { nav, fieldset { display: none; } .tall { max-height: none; } }
)css";

}  // namespace grid_path_planner::study
