#pragma once
// How every page of the analyser begins, and its style sheet: light and dark on a screen, light on paper.

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace nacre::report {

inline constexpr std::string_view kLightColours = R"css(
:root {
  --page: #fcfcfa; --panel: #ffffff; --ink: #22262b; --quiet: #626a73; --rule: #e0e2e0; --grid: #eceeec;
  --sim: #2a66a8; --meas: #c4561a; --earlier: #dfa27f; --homo: #6b7178; --thes: #8a5a9e; --rigid: #343a42; --soft: #e6dfd0; --warn: #fbeede; --bad: #b3372b;
  --fam1: #0a72b2; --fam2: #d07a00; --fam3: #00886a; --fam4: #b5518a; --fam5: #7a6a10; --fam6: #5560c0; }
)css";

inline constexpr std::string_view kDarkColours = R"css(
:root { color-scheme: light dark; }
@media screen and (prefers-color-scheme: dark) { :root {
  --page: #15181c; --panel: #1c2025; --ink: #dfe3e7; --quiet: #97a0a9; --rule: #31373e; --grid: #282d33;
  --sim: #74aee8; --meas: #f0935a; --earlier: #95603f; --homo: #9aa2ab; --thes: #c79adb; --rigid: #c3cbd4; --soft: #3a372f; --warn: #3a2b1a; --bad: #ef8d82;
  --fam1: #5cb3ec; --fam2: #f2ac45; --fam3: #3fc9a5; --fam4: #e58fbf; --fam5: #cfc05a; --fam6: #9aa4f2; } }
)css";

/// What stands in pictures; with the colours enough for one by itself.
inline constexpr std::string_view kFigureStyle = R"css(
.sim { --c: var(--sim); } .meas { --c: var(--meas); } .earlier { --c: var(--earlier); } .homo { --c: var(--homo); } .thes { --c: var(--thes); }
.fam1 { --c: var(--fam1); } .fam2 { --c: var(--fam2); } .fam3 { --c: var(--fam3); } .fam4 { --c: var(--fam4); } .fam5 { --c: var(--fam5); } .fam6 { --c: var(--fam6); }
.dot { fill: var(--c); stroke: var(--page); stroke-width: 0.8; } .ring { fill: var(--page); stroke: var(--c); stroke-width: 1.6; }
.cloud { stroke: var(--c); stroke-width: 2.6; stroke-linecap: round; opacity: 0.34; fill: none; }
@media screen and (prefers-color-scheme: dark) { .cloud { opacity: 0.6; } }
.line { stroke: var(--c); stroke-width: 1.8; fill: none; stroke-linejoin: round; } .thin { stroke-width: 1.2; opacity: 0.85; } .dashed { stroke-width: 1.4; stroke-dasharray: 5 3; }
.bar { stroke: var(--c); stroke-width: 1.1; fill: none; opacity: 0.8; } .band { fill: var(--c); opacity: 0.18; }
.grid { stroke: var(--grid); fill: none; } .axis { stroke: var(--quiet); fill: none; stroke-width: 1; }
svg text { fill: var(--quiet); font-size: 11px; } svg text.title { fill: var(--ink); font-size: 13px; font-weight: 600; } svg text.key { fill: var(--ink); }
svg text.end { text-anchor: end; } svg text.middle { text-anchor: middle; }
svg.unit { flex: none; border-radius: 3px; display: block; } .rigid { fill: var(--rigid); } .soft { fill: var(--soft); }
)css";

inline constexpr std::string_view kPageStyle = R"css(
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1160px; margin: 0 auto; padding: 40px 28px 80px; }
h1 { font-size: 30px; font-weight: 600; line-height: 1.2; margin: 0 0 14px; overflow-wrap: anywhere; }
h2 { font-size: 20px; font-weight: 600; margin: 0 0 8px; }
h3 { font-size: 16px; font-weight: 600; margin: 26px 0 8px; }
p { max-width: 78ch; margin: 0 0 12px; overflow-wrap: anywhere; }
section { margin-top: 48px; padding-top: 22px; border-top: 1px solid var(--rule); }
code { font: 0.9em ui-monospace, "DejaVu Sans Mono", Menlo, monospace; }
.eyebrow { color: var(--quiet); font-size: 13px; letter-spacing: 0.04em; margin: 0 0 4px; }
.standing { font-size: 18px; }
.quiet { color: var(--quiet); font-size: 14px; }
.awaited { color: var(--quiet); font-style: italic; }
.warning { background: var(--warn); border-left: 3px solid var(--meas); padding: 10px 14px; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; margin-top: 18px; font-size: 14px; }
a { color: var(--sim); text-decoration: none; } a:hover { text-decoration: underline; }
.figures { display: flex; flex-wrap: wrap; align-items: flex-start; gap: 18px; margin: 14px 0; }
svg.plot { display: block; max-width: 100%; height: auto; }
.wide { overflow-x: auto; margin: 12px 0; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; color: var(--quiet); padding: 4px 10px; border-bottom: 1px solid var(--rule); vertical-align: bottom; white-space: nowrap; }
td { text-align: right; padding: 4px 10px; border-bottom: 1px solid var(--grid); vertical-align: middle; }
th.group { text-align: center; }
table.words td, table.words th { text-align: left; } td:first-child, th:first-child { text-align: left; padding-left: 0; }
tr.reference td { color: var(--quiet); } tr.first-reference td { border-top: 1px solid var(--rule); } tr.invalid td { color: var(--quiet); }
tr.note td { text-align: left; color: var(--quiet); padding-top: 12px; }
thead tr + tr th:first-child { text-align: right; padding-left: 10px; }
table.words td { white-space: nowrap; } table.words code.long { display: inline-block; width: 36ch; white-space: normal; overflow-wrap: anywhere; }
table.words td:last-child { white-space: normal; min-width: 18ch; overflow-wrap: anywhere; }
table.wrapped th, table.wrapped td { white-space: normal; vertical-align: top; } table.wrapped td:last-child { white-space: nowrap; min-width: 0; }
strong.bad { color: var(--bad); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(420px, 100%), 1fr)); gap: 14px; }
.card { display: flex; gap: 14px; padding: 12px; background: var(--panel); border: 1px solid var(--rule); border-radius: 6px; font-size: 14px; }
.card p { margin: 0 0 4px; } .card table { font-size: 13px; margin: 2px 0 6px; } .card td, .card th { padding: 1px 8px; border: 0; white-space: nowrap; }
.card > div { min-width: 0; }
@media print { section { break-inside: auto; } h2, h3 { break-after: avoid; } svg, tr, .card { break-inside: avoid; } nav { display: none; } main { padding: 0; max-width: none; } }
)css";

/// From the document's first line to the open main element. `title` is safe HTML. The policy forbids the page every
/// outside resource and every script, should a text ever slip through.
inline std::string page_begin(std::string_view title, std::string_view extra_style = "") {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
      "<title>{}</title>\n<style>{}{}{}{}{}</style>\n</head>\n<body>\n<main>\n",
      title, kLightColours, kDarkColours, kFigureStyle, kPageStyle, extra_style);
}

}  // namespace nacre::report
