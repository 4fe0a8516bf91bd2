// SPDX-License-Identifier: BSD-3-Clause
// Decides who draws the stage: this browser from the figure's tables, or the program, which sends pictures. Both are
// timed, and the faster one draws.

const kTries = 4;      // the most drafts that are timed; the first one also compiles shaders
const kPatience = 250;  // ms; a draft that takes longer is the last one that is timed
const kSlow = 200;     // ms; a browser without a graphics card is timed only where the program's drafts take longer

/// Returns the device that draws WebGL 2 here; empty: there is none.
export function webgl_device() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const device = gl ? String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return device;
}

const is_software = (device) => /swiftshader|llvmpipe|softpipe|software|basic render/i.test(device);

/// Returns true if this browser may be the faster one. program: its times, {draft, rest, took} in milliseconds.
export const is_worth_timing = (device, program) => device !== "" && (!is_software(device) || program.took > kSlow);

/// Returns the milliseconds that this browser takes for a draft as large as the stage, and for the picture at rest.
export function time_casting(viewer) {
  const [width, height] = viewer.pixels(), time_sample = () => {
    const began = performance.now();
    viewer.sample = -1;
    viewer.draw_sample(width, height);
    viewer.caster.read(0, 0, 1, 1, 2);  // waits until the device has drawn
    return performance.now() - began;
  };
  let draft = Infinity, took = Infinity;
  viewer.draft_scale = 0.25;
  for (let n = 0; n < kTries && (n < 2 || took < kPatience); ++n) {
    const scale = viewer.draft_scale;
    took = viewer.draw_draft(width, height);
    draft = took / scale ** 2;
  }
  if (took > kPatience) return { draft, rest: Infinity };
  time_sample();  // the first sample also makes what all samples share
  return { draft, rest: time_sample() * viewer.figure.samples.length };
}

const ms = (value) => value === Infinity ? "unknown" : `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;

/// Returns in a sentence who draws and why. times: the times of the browser and of the program.
export function who_draws({ device, unavailable, times: { browser, program }, casts, rests }) {
  if (!device) return "The program draws: this browser has no WebGL 2.";
  if (unavailable) return unavailable;
  const say = ({ draft, rest }) => `${ms(draft)} for a draft, ${ms(rest)} at rest`;
  if (!browser && !is_worth_timing(device, program)) return `The program draws (${say(program)}): this browser has no graphics card (${device}).`;
  const who = !casts ? "The program draws" : rests ? "This browser draws" : "This browser draws while the view moves, the program at rest";
  return `${who}. This browser takes ${browser ? say(browser) : "a time not known yet"} (${device}), the program ${say(program)}.`;
}
