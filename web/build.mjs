// Bundles the page and docs/GLOSSARY.md into one folder without any reference to elsewhere.
// usage: node build.mjs [FOLDER]   (default: ../build/web)
import { build } from "esbuild";
import { copyFile, mkdir } from "node:fs/promises";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? resolve(here, "../build/web"));
await mkdir(out, { recursive: true });
await build({
  entryPoints: { page: resolve(here, "src/main.tsx") },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  loader: { ".md": "text" },
  legalComments: "inline",
  logLevel: "warning",
});
for (const file of ["index.html", "icon.svg"]) await copyFile(resolve(here, "src", file), resolve(out, file));
