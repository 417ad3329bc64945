#pragma once
// The one style sheet of all pages of this module, in light and dark on a screen, light on paper. What it says of
// pictures is also written into pictures that are files of their own (standalone.hpp).

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "pattern/phase_colours.hpp"

namespace nacre::report {

/// Soft and rigid as in films, the same in light and dark.
inline std::string phase_colours() {
  return fmt::format(":root {{ --soft: {}; --rigid: {}; }}\n", pattern::html_colour(pattern::kSoftRgb),
                     pattern::html_colour(pattern::kRigidRgb));
}

inline constexpr std::string_view kLightColours = R"css(
:root {
  --page: #fcfcfa; --panel: #ffffff; --ink: #22262b; --quiet: #626a73; --rule: #e0e2e0; --grid: #eceeec;
  --sim: #2a66a8; --meas: #c4561a; --earlier: #dfa27f; --homo: #6b7178; --thes: #8a5a9e;
  --warn: #fbeede; --bad: #b3372b;
  --fam1: #0a72b2; --fam2: #d07a00; --fam3: #00886a; --fam4: #b5518a; --fam5: #7a6a10; --fam6: #5560c0; }
)css";

inline constexpr std::string_view kDarkColours = R"css(
:root { color-scheme: light dark; }
@media screen and (prefers-color-scheme: dark) { :root {
  --page: #15181c; --panel: #1c2025; --ink: #dfe3e7; --quiet: #97a0a9; --rule: #31373e; --grid: #282d33;
  --sim: #74aee8; --meas: #f0935a; --earlier: #95603f; --homo: #9aa2ab; --thes: #c79adb;
  --warn: #3a2b1a; --bad: #ef8d82;
  --fam1: #5cb3ec; --fam2: #f2ac45; --fam3: #3fc9a5; --fam4: #e58fbf; --fam5: #cfc05a; --fam6: #9aa4f2; } }
)css";

/// What stands in pictures; with the colours enough for one by itself.
inline constexpr std::string_view kFigureStyle = R"css(
.sim { --c: var(--sim); }
.meas { --c: var(--meas); }
.earlier { --c: var(--earlier); }
.homo { --c: var(--homo); }
.thes { --c: var(--thes); }
.fam1 { --c: var(--fam1); }
.fam2 { --c: var(--fam2); }
.fam3 { --c: var(--fam3); }
.fam4 { --c: var(--fam4); }
.fam5 { --c: var(--fam5); }
.fam6 { --c: var(--fam6); }
.dot { fill: var(--c); stroke: var(--page); stroke-width: 0.8; }
.ring { fill: var(--page); stroke: var(--c); stroke-width: 1.6; }
.cloud { stroke: var(--c); stroke-width: 2.6; stroke-linecap: round; opacity: 0.34; fill: none; }
@media screen and (prefers-color-scheme: dark) { .cloud { opacity: 0.6; } }
.line { stroke: var(--c); stroke-width: 1.8; fill: none; stroke-linejoin: round; }
.steps { stroke-linejoin: miter; }
.thin { stroke-width: 1.2; opacity: 0.85; }
.dashed { stroke-width: 1.4; stroke-dasharray: 5 3; }
.bar { stroke: var(--c); stroke-width: 1.1; fill: none; opacity: 0.8; }
.band { fill: var(--c); opacity: 0.18; }
.grid { stroke: var(--grid); fill: none; }
.axis { stroke: var(--quiet); fill: none; stroke-width: 1; }
svg text { fill: var(--quiet); font-size: 11px; }
svg text.title { fill: var(--ink); font-size: 13px; font-weight: 600; }
svg text.key { fill: var(--ink); }
svg text.end { text-anchor: end; }
svg text.middle { text-anchor: middle; }
svg.unit { flex: none; border-radius: 3px; display: block; }
.rigid { fill: var(--rigid); }
.soft { fill: var(--soft); }
)css";

inline constexpr std::string_view kPageStyle = R"css(
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1160px; margin: 0 auto; padding: 40px 28px 80px; }
h1 { font-size: 30px; font-weight: 600; line-height: 1.2; margin: 0 0 14px; overflow-wrap: anywhere; }
h2 { font-size: 20px; font-weight: 600; margin: 0 0 8px; }
h3 { font-size: 16px; font-weight: 600; margin: 26px 0 8px; }
p, ol { max-width: 78ch; margin: 0 0 12px; overflow-wrap: anywhere; }
section { margin-top: 48px; padding-top: 22px; border-top: 1px solid var(--rule); }
code { font: 0.9em ui-monospace, "DejaVu Sans Mono", Menlo, monospace; }
.eyebrow { color: var(--quiet); font-size: 13px; letter-spacing: 0.04em; margin: 0 0 4px; }
.best { display: flex; flex-wrap: wrap; gap: 22px; align-items: center; margin: 0 0 18px; }
.best p { margin: 0 0 4px; }
.best .gain { font-size: 24px; line-height: 1.3; font-weight: 600; }
.standing { font-size: 18px; }
.quiet { color: var(--quiet); font-size: 14px; }
.awaited { color: var(--quiet); font-style: italic; }
.warning { background: var(--warn); border-left: 3px solid var(--meas); padding: 10px 14px; }
.legend { white-space: nowrap; }
.legend svg { display: inline-block; vertical-align: -2px; margin: 0 2px 0 6px; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; margin-top: 18px; font-size: 14px; }
a { color: var(--sim); text-decoration: none; }
a:hover { text-decoration: underline; }
.figures { display: flex; flex-wrap: wrap; align-items: flex-start; gap: 18px; margin: 14px 0; }
svg.plot { display: block; max-width: 100%; height: auto; }
svg.unit { outline: 1px solid var(--rule); }
.design { display: inline-flex; align-items: center; gap: 8px; }
.wide { overflow-x: auto; margin: 12px 0; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; color: var(--quiet); padding: 4px 10px;
  border-bottom: 1px solid var(--rule); vertical-align: bottom; }
th[title] { text-decoration: underline dotted; text-underline-offset: 3px; cursor: help; }
td { text-align: right; padding: 4px 10px; border-bottom: 1px solid var(--grid); vertical-align: middle;
  white-space: nowrap; }
th.group { text-align: center; }
table.words td, table.words th { text-align: left; }
td:first-child, th:first-child { text-align: left; padding-left: 0; }
table.named td:nth-child(2), table.named th:nth-child(2) { text-align: left; }
tr.reference td { color: var(--quiet); }
tr.first-reference td { border-top: 1px solid var(--rule); }
tr.aside td { color: var(--quiet); }
thead tr + tr th:first-child { text-align: right; padding-left: 10px; }
table.words code.long { display: inline-block; width: 36ch; white-space: normal; overflow-wrap: anywhere; }
table.words td:last-child { white-space: normal; min-width: 18ch; overflow-wrap: anywhere; }
table.wrapped th, table.wrapped td { white-space: normal; vertical-align: top; }
table.wrapped td:last-child { white-space: nowrap; min-width: 0; }
.sentence { display: inline-block; width: 44ch; white-space: normal; text-align: left; }
strong.bad { color: var(--bad); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(420px, 100%), 1fr)); gap: 14px; }
.card { display: flex; gap: 14px; padding: 12px; background: var(--panel); border: 1px solid var(--rule);
  border-radius: 6px; font-size: 14px; }
.card p { margin: 0 0 4px; }
.card table { font-size: 13px; margin: 2px 0 6px; }
.card td, .card th { padding: 1px 8px; border: 0; }
.card > div { min-width: 0; }
@media print {
  section { break-inside: auto; }
  h2, h3 { break-after: avoid; }
  svg, tr, .card { break-inside: avoid; }
  nav, .files { display: none; }
  main { padding: 0; max-width: none; } }
)css";

}  // namespace nacre::report
