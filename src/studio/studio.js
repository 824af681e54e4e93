"use strict";
const $ = (id) => document.getElementById(id);
const state = { text: "", saved: "", pinned: null, undo: [], redo: [], look: null, scene: null, playing: false, torque: 0 };

const thisPage = Math.random().toString(36).slice(2);

/* A question to the engine. `sprag` is the engine within the page where there is no server. */
const engine = {
  async ask(what, question, signal) {
    if (window.sprag) {
      const found = await window.sprag.ask(what, question);
      signal?.throwIfAborted();
      return found;
    }
    let answer;
    try {
      answer = await fetch("ask/" + what, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ ...question, page: thisPage }), signal });
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw { message: "the studio does not answer: was it ended? Start `sprag-design studio` again; what you changed is still on this page" };
    }
    const value = await answer.json();
    if (!answer.ok) throw value;
    return value;
  },
};

/* The newest question of each kind alone counts; an older one is given up. */
const latest = {};
async function newest(kind, work) {
  latest[kind]?.abort();
  const mine = (latest[kind] = new AbortController());
  try {
    const value = await work(mine.signal);
    return latest[kind] === mine ? value : undefined;
  } catch (error) {
    if (mine.signal.aborted || error.name === "AbortError") return undefined;
    throw error;
  }
}
const complain = (error) => say(error.message || String(error), true);
function say(text, bad = false) { $("work").textContent = text; $("work").style.color = bad ? "var(--bad)" : ""; }
const escaped = (text) => { const span = document.createElement("span"); span.textContent = text; return span.innerHTML; };
// Below a millionth of a degree a windup is what rounding leaves of a difference.
const degrees = (rad) => { const deg = (rad * 180) / Math.PI; return (Math.abs(deg) < 1e-6 ? "0" : short(deg)) + "°"; };
const short = (x, digits = 4) => (x === 0 ? "0" : Number(x.toPrecision(digits)).toString());

/* Looks ------------------------------------------------------------------------------------------------------------ */
async function look() {
  const text = state.text;
  const found = await newest("check", (signal) => engine.ask("check", { text, pinned: state.pinned }, signal));
  // A change may have come in between: its answer is newer, but may not know what has been pinned.
  if (found) return text === state.text ? show(found) : look();
}

/* One change at a time is on its way; of those made meanwhile the last one follows. An undo overtakes them all. */
let changing = false, waiting = null, overtaken = 0;
async function change(path, value, field, before) {
  if (changing) { waiting = [path, value, field, before]; return; }
  changing = true;
  const asked = overtaken;
  try {
    const found = await engine.ask("change", { text: state.text, path, value: String(value), pinned: state.pinned });
    if (asked !== overtaken) return;
    if (before !== found.text && state.undo.at(-1) !== before) { state.undo.push(before); state.redo = []; }
    state.text = found.text;
    built.forEach((each) => fault(each, ""));
    say("");
    show(found.look);
  } catch (error) {
    fault(field, error.message || String(error));
  } finally {
    changing = false;
    if (waiting) { const next = waiting; waiting = null; change(...next); }
  }
}
/* A value that is refused stays in its field with why; the answers are those of the design before it, and say so. */
function fault(field, text) {
  if (field.querySelector(".error").textContent === text) return;
  field.classList.toggle("bad", text !== "");
  field.querySelector(".error").textContent = text;
  if (state.look) rows();
}

function show(found) {
  state.look = found;
  $("name").textContent = found.name;
  document.title = found.name + " – studio";
  $("figures").innerHTML = found.figures.map((f) => `<div><dt>${escaped(f.name)}</dt><dd>${escaped(f.text)}${f.pinned ? ` <span class="was">pinned ${escaped(f.pinned)}</span>` : ""}</dd></div>`).join("");
  $("windup").innerHTML = found.windup_svg;
  $("tangent").innerHTML = found.tangent_svg;
  buttons();
  fields(found.fields);
  scenarios(found.scenarios);
  picture();
  scenesLater();
  rows();
}
function buttons() {
  $("undo").disabled = state.undo.length === 0;
  $("redo").disabled = state.redo.length === 0;
  $("swap").disabled = $("unpin").disabled = state.pinned === null;
  $("optimise").disabled = !state.look?.has_task || !!window.sprag;
  if (window.sprag) $("optimise").title = "Searches need the program: sprag-design studio";
}

/* Margins ---------------------------------------------------------------------------------------------------------- */
const known = { scenes: {}, pinned: {}, pinnedScenes: {}, pinnedOf: null };
function rows() {
  const fromScenes = Object.values(known.scenes).flatMap((s) => s.margins);
  const all = state.look.margins.concat(fromScenes);
  all.sort((a, b) => b.required - a.required || a.margin - b.margin);
  const html = (list) => list.map((m) => {
    const was = known.pinned[m.code];
    const before = state.pinned && was && was !== m.text ? `<br><span class="was">pinned ${escaped(was)}</span>` : "";
    return `<tr class="${m.tone}" title="${escaped(m.name).replaceAll('"', "&quot;")}" data-code="${escaped(m.code)}"><td><span class="dot"></span>${escaped(m.code)}</td><td class="n">${escaped(m.text)}${before}</td><td class="n soft">${escaped(m.against)}${m.reached ? `<br>at ${escaped(m.reached)}` : ""}</td></tr>`;
  }).join("");
  verdict(all.filter((m) => m.required));
  $("margins").tBodies[0].innerHTML = html(all.filter((m) => m.required));
  $("shown").tBodies[0].innerHTML = html(all.filter((m) => !m.required));
  $("scenes").tBodies[0].innerHTML = Object.values(known.scenes).map((s) => {
    const top = 1.5 * s.static_friction;
    const part = (mu) => `${Math.min(100, (100 * mu) / top)}%`;
    const was = state.pinned ? known.pinnedScenes[s.name] : undefined;
    const ghost = was !== undefined && was !== s.required_friction;
    const pinned = was === null ? "none suffices" : ghost ? "μ " + short(was, 4) : "";
    const mark = ghost && was !== null ? `<u style="left:${part(was)}" title="pinned: ${pinned}"></u>` : "";
    const bar = s.required_friction === null ? "" : `<div class="bar"><i style="width:${part(s.required_friction)}"></i>${mark}<b style="left:${part(s.static_friction)}" title="static friction ${s.static_friction}"></b></div>`;
    const word = (s.required_friction === null ? escaped(s.note || "none suffices") : "μ " + short(s.required_friction, 4)) + (ghost ? `<br><span class="was">pinned ${pinned}</span>` : "");
    return `<tr class="${s.stale ? "stale" : ""}"><td>${escaped(s.name)}</td><td class="n">${word}</td><td>${bar}</td></tr>`;
  }).join("");
}

/* The verdict of `check`: static limits at once, those of the scenes as they come. */
function verdict(required) {
  const running = state.look.scenarios.some((name) => !known.scenes[name] || known.scenes[name].stale);
  const broken = required.filter((m) => m.tone === "red"), first = required[0];
  const decides = first && `${first.code} decides, margin ${first.text}`;
  const some = broken.length > 1 ? `${broken.length} limits` : "1 limit";
  $("banner").textContent = !first ? "No limit is named" : broken.length ? `NOT HELD: ${some} of ${required.length}${running ? " so far" : ""}; ${decides}` : running ? `Static limits held, scenes are running …; ${decides} so far` : `HELD: all ${required.length} required limits; ${decides}`;
  const refused = [...built].filter(([, field]) => field.classList.contains("bad")).map(([path]) => path);
  if (refused.length) $("banner").textContent = `${refused.join(", ")} refused; without it: ${$("banner").textContent}`;
  $("banner").className = "verdict " + (refused.length || !first || (running && !broken.length) ? "mixed" : broken.length ? "broken" : "held");
}

/* Scenes follow when the sliders rest. */
let later = 0;
function scenesLater() {
  clearTimeout(later);
  for (const s of Object.values(known.scenes)) s.stale = true;
  later = setTimeout(() => newest("scenes", allScenes).catch(complain), 120);
}
async function allScenes(signal) {
  const text = state.text, names = state.look.scenarios;
  for (const name of Object.keys(known.scenes)) if (!names.includes(name)) delete known.scenes[name];
  if ($("mode").value) play($("mode").value, signal).catch((error) => signal.aborted || complain(error));
  for (const name of names) {
    const found = await engine.ask("scene_row", { text, name }, signal);
    if (signal.aborted) return;
    known.scenes[name] = found;
    delete found.stale;
    rows();
  }
  const pinned = state.pinned;
  if (pinned === null || known.pinnedOf === pinned) return;
  known.pinnedScenes = {};
  for (const name of names) {
    // A scenario that the pinned design does not have has no ghost.
    const found = await engine.ask("scene_row", { text: pinned, name }, signal).catch((error) => { if (signal.aborted) throw error; });
    if (signal.aborted) return;
    if (!found) continue;
    known.pinnedScenes[name] = found.required_friction;
    for (const m of found.margins) known.pinned[m.code] = m.text;
    rows();
  }
  known.pinnedOf = pinned;
}

/* Fields ----------------------------------------------------------------------------------------------------------- */
let shown = "";
function fields(list) {
  const paths = list.map((f) => f.path).join();
  if (paths !== shown) { shown = paths; build(list); }
  for (const f of list) {
    const field = built.get(f.path);
    const before = pinnedFields[f.path];
    field.querySelector("label").classList.toggle("moved", state.pinned !== null && before !== undefined && before !== (f.value ?? f.choice[0]));
    for (const input of field.querySelectorAll("input, select")) {
      if (input === document.activeElement && input.type !== "range" && field.classList.contains("bad")) continue;
      if (input !== document.activeElement || input.type === "range") input.value = f.value ?? f.choice[0];
      if (input.type !== "range") continue;
      const beyond = Number(f.value) < f.range[0] || Number(f.value) > f.range[1];
      input.classList.toggle("stale", beyond);
      input.title = `${short(f.range[0])} to ${short(f.range[1])} ${f.unit}${beyond ? ": the value lies outside" : ""}`;
    }
  }
}
let pinnedFields = {};
const built = new Map();
function build(list) {
  built.clear();
  const groups = Map.groupBy ? Map.groupBy(list, (f) => f.group) : list.reduce((m, f) => m.set(f.group, [...(m.get(f.group) || []), f]), new Map());
  $("fields").innerHTML = "";
  for (const [group, members] of groups) {
    const details = document.createElement("details");
    details.open = ["sprags", "limits"].includes(group);
    details.innerHTML = `<summary>${escaped(group)}</summary>`;
    for (const f of members) {
      built.set(f.path, fieldOf(f));
      details.append(built.get(f.path));
    }
    $("fields").append(details);
  }
}
function fieldOf(f) {
  const field = document.createElement("div");
  field.className = "field";
  field.dataset.path = f.path;
  const label = document.createElement("label");
  label.innerHTML = escaped(f.label).replaceAll("_", "_<wbr>").replaceAll(".", ".<wbr>");
  label.title = f.meaning;
  const error = document.createElement("p");
  error.className = "error";
  error.setAttribute("role", "alert");
  let before = "";
  const begin = () => { before = state.text; };
  const listen = (input, event) => {
    input.addEventListener("pointerdown", begin);
    input.addEventListener("focus", begin);
    input.addEventListener(event, () => {
      const typed = input.value.trim();
      if (f.choice || Number.isFinite(Number(typed || NaN))) return change(f.path, typed, field, before || state.text);
      if (typed.includes(",")) return fault(field, `found ${typed}; decimals stand behind a point, thousands without a mark`);
      fault(field, "a number is needed: the one before stands");
      fields(state.look.fields);
    });
    input.addEventListener("change", () => { before = state.text; });
    input.setAttribute("aria-label", f.path);
  };
  if (f.choice) {
    const select = document.createElement("select");
    f.choice[1].forEach((name) => select.add(new Option(name, name)));
    listen(select, "change");
    field.append(label, select, document.createElement("span"), error);
    return field;
  }
  const number = document.createElement("input");
  // As text, since a browser's own number fields drop a comma without a word: 400,5 would be 4005.
  number.inputMode = "decimal";
  number.spellcheck = false;
  number.id = "n:" + f.path;
  label.htmlFor = number.id;
  listen(number, "change");
  const unit = document.createElement("span");
  unit.className = "soft";
  unit.textContent = f.unit;
  field.append(label, number, unit);
  if (f.range) {
    const slider = document.createElement("input");
    slider.type = "range";
    [slider.min, slider.max] = f.range;
    slider.step = f.whole ? "1" : String((f.range[1] - f.range[0]) / 400);
    listen(slider, "input");
    slider.addEventListener("input", () => { number.value = f.whole ? slider.value : short(Number(slider.value), 6); });
    field.append(slider);
  }
  field.append(error);
  return field;
}
$("find").addEventListener("input", () => {
  const wanted = $("find").value.toLowerCase();
  document.querySelectorAll(".field").forEach((field) => { field.hidden = !field.dataset.path.toLowerCase().includes(wanted) && !field.querySelector("label").title.toLowerCase().includes(wanted); field.style.display = field.hidden ? "none" : ""; });
  document.querySelectorAll("#fields details").forEach((d) => {
    if (wanted) d.open = true;
    d.hidden = ![...d.querySelectorAll(".field")].some((field) => !field.hidden);
  });
});

/* Picture ---------------------------------------------------------------------------------------------------------- */
function picture() {
  const p = state.look.picture;
  $("live").innerHTML = p ? p.svg : "<p>This profile cannot be drawn.</p>";
  pose();
}
function scenarios(names) {
  const mode = $("mode"), chosen = mode.value;
  if ([...mode.options].slice(1).map((o) => o.value).join() === names.join()) return;
  mode.length = 1;
  names.forEach((name) => mode.add(new Option("scene " + name, name)));
  mode.value = names.includes(chosen) ? chosen : "";
}
/* The equilibrium at `x` of column `key`, between two rows. */
function at(key, x, rows = state.look.poses) {
  let low = 0, high = rows.length - 1;
  if (rows.length === 0) return null;
  if (x <= rows[0][key]) return rows[0];
  while (high - low > 1) { const middle = (low + high) >> 1; if (rows[middle][key] <= x) low = middle; else high = middle; }
  const a = rows[low], b = rows[high], span = b[key] - a[key];
  const share = span > 0 ? Math.min(1, (x - a[key]) / span) : 0;
  return Object.fromEntries(Object.keys(a).map((k) => [k, a[k] + share * (b[k] - a[k])]));
}
function pose() {
  const { look: found, scene } = state;
  if (!found?.picture || found.poses.length === 0) return;
  const part = Number($("scrub").value) / 1000;
  let here, forces, slips = [0, 0], relative, largest;
  if (scene && scene.t_s.length > 0) {
    const i = Math.round(part * (scene.t_s.length - 1));
    here = at("alpha_rad", scene.alpha_rad[i]);
    const first = found.poses[0];
    if (scene.alpha_rad[i] < first.alpha_rad) here = { ...first, rotation_rad: first.rotation_rad + scene.alpha_rad[i] - first.alpha_rad };
    forces = scene.forces_n[i];
    slips = scene.modes[i];
    // The windup at the start is that of the equilibrium there.
    relative = scene.relative_rad[i] - scene.relative_rad[0] - at("alpha_rad", scene.alpha_rad[0]).windup_rad;
    largest = Math.max(...scene.forces_n.map((f) => Math.hypot(f[0], f[1])), 1);
    $("now").textContent = scene.t_s.length > 1 ? `${short(1e3 * scene.t_s[i], 5)} ms` : "";
    const [from, to] = scene.frame;
    document.querySelectorAll("#plots .cursor").forEach((c) => { c.style.left = `${100 * (from + part * (to - from))}%`; });
  } else {
    // The torque stays when the curve's end moves: forces before and after a change are at the same one.
    const top = topTorque(), torque = Math.min(state.torque, top);
    if (!$("mode").value) $("scrub").value = (1000 * torque) / top;
    here = at("torque_nm", torque);
    forces = [here.normal_inner_n, here.tangential_inner_n, here.normal_outer_n, here.tangential_outer_n];
    relative = -here.windup_rad;
    const last = at("torque_nm", top);
    largest = Math.hypot(last.normal_inner_n, last.tangential_inner_n);
    $("now").textContent = `${short(torque, 4)} Nm`;
  }
  draw(here, forces, slips, relative, largest);
  const read = [["N inner", short(forces[0]) + " N"], ["T inner", short(forces[1]) + " N"], ["T/N inner", slips[0] === 3 ? "cage" : forces[0] > 0 ? short(forces[1] / forces[0]) : "open"], ["windup", degrees(-relative)]];
  if (!scene) read.push(["Hertz inner", short(here.hertz_inner_pa / 1e6) + " MPa"]);
  $("readings").innerHTML = read.map(([k, v]) => `<div><dt>${k}</dt><dd>${v}</dd></div>`).join("");
}
function draw(here, forces, slips, relative, largest) {
  const { picture: p, outer_radii_m: [re, track] } = state.look;
  const svg = $("live").querySelector("svg"), [ox, oy] = p.o_px, scale = p.scale_px_per_m, deg = 180 / Math.PI;
  const ce = oy - here.oc_e_m * scale;
  svg.querySelector(".sprag").setAttribute("transform", `translate(${ox} ${ce}) rotate(${here.rotation_rad * deg})`);
  // The outer race rolls on the sprag; the inner one is behind it by the windup.
  const outer = (here.rotation_rad * re) / track;
  svg.querySelector(".outer").setAttribute("transform", `rotate(${outer * deg} ${ox} ${oy})`);
  svg.querySelector(".inner").setAttribute("transform", `rotate(${(outer + relative) * deg} ${ox} ${oy})`);
  // The pinned sprag at the same torque; in a scene at first contact.
  const ghost = svg.querySelector(".ghost"), pinned = state.scene ? state.look.pinned_poses[0] : at("torque_nm", here.torque_nm, state.look.pinned_poses);
  if (ghost && pinned) ghost.setAttribute("transform", `translate(${ox} ${oy - pinned.oc_e_m * scale}) rotate(${pinned.rotation_rad * deg})`);
  const [s, c] = [Math.sin(here.beta_rad), Math.cos(here.beta_rad)];
  const a = [ox + here.oa_m * s * scale, oy - here.oa_m * c * scale], b = [ox, oy - here.ob_m * scale];
  const px = 150 / largest;
  // Forces on the sprag: N at A outward, T_bi against positive azimuth; N at B inward, T_be along it.
  const arrow = (from, [x, y], colour) => {
    const length = Math.hypot(x, y);
    if (length < 2) return "";
    const [ux, uy] = [x / length, y / length], [tx, ty] = [from[0] + x, from[1] + y], h = Math.min(9, length / 2);
    return `<path d="M${from[0]} ${from[1]}L${tx} ${ty}M${tx - h * ux + 0.5 * h * uy} ${ty - h * uy - 0.5 * h * ux}L${tx} ${ty}L${tx - h * ux - 0.5 * h * uy} ${ty - h * uy + 0.5 * h * ux}" fill="none" stroke="${colour}" stroke-width="2.2"/>`;
  };
  const [na, ta, nb, tb] = forces.map((f) => f * px);
  const dot = (at, slip) => `<circle cx="${at[0]}" cy="${at[1]}" r="${slip ? 8 : 4.5}" fill="${slip === 2 ? "none" : slip ? "var(--bad)" : "var(--ink)"}" stroke="${slip ? "var(--bad)" : "var(--paper)"}" stroke-width="1.5"><title>${slip === 2 ? "open" : slip ? "slips" : "sticks"}</title></circle>`;
  const label = (at, text, colour) => `<text x="${at[0] + 12}" y="${at[1] + 4}" fill="${colour}">${text}</text>`;
  const word = (slip) => (slip === 3 ? "held by the cage" : slip === 2 ? "open" : slip ? (slip > 0 ? "slips, race ahead" : "slips, race behind") : "");
  // Lines of the legend are apart by the size of its letters, which a narrow window makes larger.
  svg.querySelector(".forces").innerHTML =
    arrow(a, [s * na, -c * na], "var(--c0)") + arrow(a, [-c * ta, -s * ta], "var(--c3)") +
    arrow(b, [0, nb], "var(--c0)") + arrow(b, [tb, 0], "var(--c3)") +
    dot(a, slips[0]) + dot(b, slips[1]) + label([a[0], a[1] + 14], "A " + word(slips[0]), "var(--ink)") + label([b[0], b[1] - 10], "B " + word(slips[1]), "var(--ink)") +
    `<text x="12" y="4">${[["normal force", "--c0"], ["tangential force", "--c3"], [`longest arrow: ${short(largest, 3)} N`, "--soft"]].map(([line, ink]) => `<tspan x="12" dy="1.25em" fill="var(${ink})">${line}</tspan>`).join("")}</text>`;
}

/* Scenes, played --------------------------------------------------------------------------------------------------- */
async function play(name, signal) {
  const found = await engine.ask("scene", { text: state.text, pinned: state.pinned, name }, signal);
  if (signal?.aborted || $("mode").value !== name) return;
  state.scene = found;
  $("course").hidden = false;
  $("play").hidden = $("slowly").hidden = $("scrub").hidden = found.t_s.length < 2;
  $("verdict").textContent = `${found.name}: ${found.verdict}`;
  $("verdict").className = "verdict " + (found.verdict === "sticks" || found.verdict.startsWith("runs free") ? "held" : found.verdict === "no verdict" ? "mixed" : "broken");
  $("facts").innerHTML = found.facts.map(([k, v]) => `<div><dt>${escaped(k)}</dt><dd>${escaped(v)}</dd></div>`).join("");
  $("plots").innerHTML = found.plots.map((svg) => `<div>${svg}<span class="cursor"></span></div>`).join("");
  pose();
}
$("mode").addEventListener("change", () => {
  stop();
  const name = $("mode").value;
  state.scene = null;
  $("course").hidden = $("play").hidden = $("slowly").hidden = true;
  $("scrub").hidden = false;
  if (!name) return pose();
  $("scrub").value = 0;
  newest("scene", (signal) => play(name, signal)).catch(complain);
});
// The torque at the right end of its slider.
function topTorque() {
  const { end, asked_nm } = state.look;
  return Math.min(end[0], 1.5 * asked_nm || end[0]);
}
function stop() { state.playing = false; $("play").textContent = "Play"; }
$("play").addEventListener("click", () => {
  if (state.playing) return stop();
  state.playing = true;
  $("play").textContent = "Pause";
  let last = performance.now(), value = Number($("scrub").value) % 1000;
  const step = (now) => {
    if (!state.playing) return;
    value += ((now - last) / (1000 * Number($("pace").value))) * 1000;
    last = now;
    if (value >= 1000) { value = 1000; stop(); }
    $("scrub").value = value;
    pose();
    if (state.playing) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
});
$("scrub").addEventListener("input", () => {
  stop();
  if (!$("mode").value) state.torque = (Number($("scrub").value) / 1000) * topTorque();
  pose();
});

/* Undo, pin, save, search ------------------------------------------------------------------------------------------ */
const go = (from, to) => () => {
  if (state[from].length === 0) return;
  state[to].push(state.text);
  state.text = state[from].pop();
  waiting = null;
  overtaken += 1;
  built.forEach((field) => fault(field, ""));
  buttons();
  look().catch(complain);
};
$("undo").addEventListener("click", go("undo", "redo"));
$("redo").addEventListener("click", go("redo", "undo"));
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches("input:not([type=range], [type=checkbox])")) return;
  if (event.key === "z" && !event.shiftKey) { event.preventDefault(); $("undo").click(); }
  if (event.key === "y" || (event.key === "z" && event.shiftKey)) { event.preventDefault(); $("redo").click(); }
});
function remember(margins, list) {
  known.pinned = Object.fromEntries(margins.map((m) => [m.code, m.text]));
  pinnedFields = Object.fromEntries(list.map((f) => [f.path, f.value ?? f.choice[0]]));
}
$("pin").addEventListener("click", () => {
  state.pinned = state.text;
  remember(state.look.margins.concat(Object.values(known.scenes).flatMap((s) => s.margins)), state.look.fields);
  look().catch(complain);
});
$("unpin").addEventListener("click", () => { state.pinned = null; known.pinned = {}; pinnedFields = {}; look().catch(complain); });
$("swap").addEventListener("click", () => {
  const margins = state.look.margins.concat(Object.values(known.scenes).flatMap((s) => s.margins)), list = state.look.fields;
  state.undo.push(state.text);
  [state.text, state.pinned] = [state.pinned, state.text];
  remember(margins, list);
  look().catch(complain);
});
$("save").addEventListener("click", () => {
  if (window.sprag) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([state.text], { type: "application/toml" }));
    link.download = $("filename").value;
    link.click();
    state.saved = state.text;
    return;
  }
  unsaved("");
});
/* Asks for the name; `why` the last one would not do. */
function unsaved(why) {
  $("unsaved").textContent = why;
  $("saving").returnValue = "";
  $("saving").showModal();
}
$("saving").addEventListener("close", async () => {
  if ($("saving").returnValue !== "save") return;
  try {
    const found = await engine.ask("save", { text: state.text, name: $("filename").value, replace: $("replace").checked ? "yes" : "no" });
    state.saved = state.text;
    say("written: " + found.path);
  } catch (error) { complain(error); unsaved(error.message || String(error)); }
});
window.addEventListener("beforeunload", (event) => { if (state.text !== state.saved) event.preventDefault(); });

let searching = false;
$("optimise").addEventListener("click", async () => {
  if (searching) { engine.ask("stop", {}).catch(complain); return; }
  try {
    const begun = await engine.ask("optimise", { text: state.text });
    searching = true;
    $("optimise").textContent = "Stop";
    say(begun.said);
    // Most searches end in less than a second: asked often at first, then seldom.
    for (let pause = 50; ; pause = Math.min(2 * pause, 400)) {
      await new Promise((wait) => setTimeout(wait, pause));
      const found = await engine.ask("progress", {});
      say(found.said);
      if (found.running) continue;
      if (found.text) {
        const pinned = await engine.ask("check", { text: found.text });
        state.pinned = found.text;
        remember(pinned.margins, pinned.fields);
        await look();
        say(found.said.replace(/[.]?$/, ".") + " It is the pinned one now; Swap takes it.");
      }
      break;
    }
  } catch (error) { complain(error); } finally { searching = false; $("optimise").textContent = "Optimise"; }
});

async function load(first) {
  try {
    if (state.text) { state.undo.push(state.text); state.redo = []; }
    state.text = state.saved = first.text;
    $("file").textContent = first.file;
    $("filename").value = first.save_as;
    await look();
    // Nominal torque, or where nobody names one a good way up.
    state.torque = state.look.nominal_nm > 0 ? state.look.nominal_nm : 0.6 * topTorque();
    pose();
  } catch (error) { complain(error); $("banner").textContent = error.message || String(error); $("banner").className = "verdict broken"; }
}
$("load").hidden = !window.sprag;
const chosen = $("load").querySelector("input");
$("load").addEventListener("click", (event) => event.target !== chosen && chosen.click());
chosen.addEventListener("change", async () => {
  const file = chosen.files[0];
  chosen.value = "";
  if (file) await load({ text: await file.text(), file: file.name, save_as: file.name });
});
engine.ask("open", {}).then(load, complain);
