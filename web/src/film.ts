// Fracture films: docs/FORMATS.md, "Fracture films".

export interface Film {
  design: string;
  fidelity: string;
  end: string;
  columns: number;
  rows: number;
  elementSize: number;
  toughness: number;
  peakStress: number;
  failureStrain: number;
  curve: { strain: number[]; stress_pa: number[] };
  frames: { strain: number; stress_pa: number; broken: number }[];
  levels: number;
  material: Uint8Array;
  breaks: Int32Array;
  /** Per frame a level per element. */
  energy: Uint8Array[];
  /** Per frame x of all nodes, then y, in metres beyond the uniform stretch. */
  displacement: Float32Array[];
  path: number[] | null;
}

async function inflated(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Sums changes per frame; `values` has one entry per item and frame. */
function energyOf(bytes: Uint8Array, frames: number): Uint8Array[] {
  const count = bytes.length / frames;
  const levels: Uint8Array[] = [];
  let before = new Uint8Array(count);
  for (let f = 0; f < frames; ++f) {
    const now = new Uint8Array(count);
    for (let i = 0; i < count; ++i) now[i] = before[i] + bytes[f * count + i];
    levels.push((before = now));
  }
  return levels;
}

function displacementOf(bytes: Uint8Array, frames: number, step: number): Float32Array[] {
  const total = bytes.length / 2;
  const count = total / frames;
  const steps = new Int16Array(count);
  const result: Float32Array[] = [];
  for (let f = 0; f < frames; ++f) {
    const metres = new Float32Array(count);
    for (let i = 0; i < count; ++i) {
      const k = f * count + i;
      steps[i] += bytes[k] | (bytes[total + k] << 8);
      metres[i] = steps[i] * step;
    }
    result.push(metres);
  }
  return result;
}

export async function readFilm(buffer: ArrayBuffer): Promise<Film> {
  const view = new DataView(buffer);
  if (new TextDecoder().decode(buffer.slice(0, 8)) !== "NACREFLM" || view.getUint32(8, true) !== 1)
    throw new Error("the fracture film has an unknown format");
  const length = view.getUint32(12, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 16, length)));
  const sections = new Map<string, Uint8Array>();
  let at = 16 + length;
  for (const section of header.sections as { name: string; bytes: number }[]) {
    sections.set(section.name, await inflated(new Uint8Array(buffer, at, section.bytes)));
    at += section.bytes;
  }
  const section = (name: string) => {
    const found = sections.get(name);
    if (!found) throw new Error(`the film lacks its section ${name}`);
    return found;
  };
  const breaks = section("breaks");
  return {
    design: header.design,
    fidelity: header.fidelity,
    end: header.end,
    columns: header.columns,
    rows: header.rows,
    elementSize: header.element_size_m,
    toughness: header.toughness_pa,
    peakStress: header.peak_stress_pa,
    failureStrain: header.failure_strain,
    curve: header.curve,
    frames: header.frames,
    levels: header.energy.levels,
    material: section("material"),
    breaks: new Int32Array(breaks.slice(0, breaks.length / 2).buffer),
    energy: energyOf(section("energy"), header.frames.length),
    displacement: displacementOf(section("displacement"), header.frames.length, header.displacement_step_m),
    path: header.crack?.path?.elements ?? null,
  };
}
