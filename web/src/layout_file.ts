// A pattern from a file: 20 lines of 0 and 1, a key, or a picture of two colours at any multiple of the pixels.

import { keyOfPixels, pixelsOf, SIDE } from "./pattern";

/** Why a file is no pattern, as a sentence. */
export class LayoutFault extends Error {}

const MOST_BYTES = 8 << 20;
const MOST_POINTS = 4000; // along a side of a picture

/** The design of a layout with the eightfold symmetry; throws a LayoutFault that names the first pixels that differ. */
export function symmetricKey(pixels: Uint8Array): string {
  const differing: string[] = [];
  let count = 0;
  const material = (i: number) => (pixels[i] ? "rigid" : "soft");
  const place = (i: number) => `row ${Math.floor(i / SIDE) + 1}, column ${(i % SIDE) + 1}`;
  const whole = pixelsOf(keyOfPixels(pixels))!;
  for (let i = 0; i < pixels.length; ++i) {
    if (pixels[i] === whole[i]) continue;
    ++count;
    const [row, column] = [Math.floor(i / SIDE), i % SIDE].map((k) => Math.min(k, SIDE - 1 - k));
    const image = Math.min(row, column) * SIDE + Math.max(row, column);
    if (differing.length === 0)
      differing.push(`${place(i)} is ${material(i)}, its mirror image ${place(image)} ${material(image)}`);
  }
  if (count > 0)
    throw new LayoutFault(
      `It lacks the eightfold symmetry: ${differing[0]}. ${count} of the ${pixels.length} pixels differ from their ` +
        "images in the upper left eighth.",
    );
  return keyOfPixels(pixels);
}

/** 20 lines of 20 characters 0 (soft) or 1 (rigid), or a design's key. */
export function pixelsOfText(text: string): Uint8Array {
  const lines = text.replace(/^\ufeff/, "").split(/\r?\n/);
  while (lines.at(-1)?.trim() === "") lines.pop();
  const key = lines.length === 1 ? pixelsOf(lines[0].trim()) : null;
  if (key) return key;
  if (lines.length !== SIDE)
    throw new LayoutFault(
      `It has ${lines.length} lines, expected ${SIDE} of ${SIDE} characters 0 (soft) or 1 (rigid).`,
    );
  const pixels = new Uint8Array(SIDE * SIDE);
  for (const [row, line] of lines.entries()) {
    const fault = [...line].findIndex((letter) => letter !== "0" && letter !== "1");
    if (fault >= 0)
      throw new LayoutFault(
        `Line ${row + 1}, column ${fault + 1}: “${[...line][fault]}”, expected 0 (soft) or 1 (rigid).`,
      );
    if (line.length !== SIDE)
      throw new LayoutFault(`Line ${row + 1} has ${line.length} characters, expected ${SIDE}.`);
    for (let column = 0; column < SIDE; ++column) pixels[row * SIDE + column] = Number(line[column]);
  }
  return pixels;
}

const luminance = (rgb: number) => 0.2126 * (rgb & 255) + 0.7152 * ((rgb >> 8) & 255) + 0.0722 * ((rgb >> 16) & 255);

/** Pixels of a picture, its points as ImageData has them: the lighter colour is rigid. */
export function pixelsOfPicture({ data, width, height }: Pick<ImageData, "data" | "width" | "height">): Uint8Array {
  if (width !== height || width % SIDE !== 0 || width === 0)
    throw new LayoutFault(`It has ${width} x ${height} points, expected a square whose side is a multiple of ${SIDE}.`);
  const points = new Uint32Array(data.buffer, data.byteOffset, width * height);
  const size = width / SIDE;
  const colours = new Set<number>();
  const cells = new Uint32Array(SIDE * SIDE);
  for (let i = 0; i < points.length; ++i) {
    const [row, column] = [Math.floor(i / width / size), Math.floor((i % width) / size)];
    const cell = row * SIDE + column;
    const isFirst = Math.floor(i / width) % size === 0 && (i % width) % size === 0;
    if (points[i] >>> 24 !== 255)
      throw new LayoutFault(`Pixel row ${row + 1}, column ${column + 1} is transparent, expected two opaque colours.`);
    if (isFirst) cells[cell] = points[i];
    else if (cells[cell] !== points[i])
      throw new LayoutFault(
        `Pixel row ${row + 1}, column ${column + 1} has several colours, expected one: save the picture without ` +
          "smoothing, as PNG.",
      );
    colours.add(points[i]);
    if (colours.size > 2)
      throw new LayoutFault(
        `Pixel row ${row + 1}, column ${column + 1} has a third colour, expected two: light for rigid, dark for soft.`,
      );
  }
  if (colours.size < 2) throw new LayoutFault("It has one colour, expected two: light for rigid, dark for soft.");
  const [one, other] = [...colours];
  const rigid = luminance(one) > luminance(other) ? one : other;
  return Uint8Array.from(cells, (colour) => Number(colour === rigid));
}

async function pictureIn(file: Blob): Promise<ImageData> {
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(file, { colorSpaceConversion: "none" });
  } catch {
    throw new LayoutFault("It is neither a picture that the browser reads nor a text of 0 and 1.");
  }
  const { width, height } = bitmap;
  if (Math.max(width, height) > MOST_POINTS)
    throw new LayoutFault(`It has ${width} x ${height} points, expected at most ${MOST_POINTS} along a side.`);
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, width, height);
}

/** The key of the pattern in a file; throws a LayoutFault. */
export async function keyInFile(file: File): Promise<string> {
  if (file.size > MOST_BYTES)
    throw new LayoutFault(`It has ${(file.size / 1e6).toFixed(1)} MB, expected at most ${MOST_BYTES >> 20} MiB.`);
  const isText = file.type.startsWith("text/") || /\.(txt|csv)$/i.test(file.name);
  return symmetricKey(isText ? pixelsOfText(await file.text()) : pixelsOfPicture(await pictureIn(file)));
}
