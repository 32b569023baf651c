"use strict";
(() => {
  const LIGHT = { ink: "#1b1f24", faint: "#5b6570", grid: "#e3e7eb", paper: "#ffffff",
    engines: ["#0072b2", "#d55e00", "#009e73", "#b3588f", "#c08a00", "#3d93c9", "#6b6b6b"] };
  const DARK = { ink: "#e4e8ec", faint: "#9aa5b1", grid: "#2c333b", paper: "#14171b",
    engines: ["#5ab4f0", "#ff9a4d", "#2fcb9f", "#e79bc6", "#f2c14e", "#a6d8f7", "#b9b9b9"] };
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const PAPER = { cost: 670, motion: 325 };
  let printing = false;

  const theme = () => (dark.matches && !printing ? DARK : LIGHT);
  const color = (engine) => (engine < 0 ? theme().ink : theme().engines[engine % theme().engines.length]);

  function frame(plot, height) {
    const { ink, faint, paper } = theme();
    const width = printing ? PAPER[plot.cost ? "cost" : "motion"] : plot.canvas.clientWidth;
    return {
      width, height: Math.min(printing ? 290 : height, 0.75 * width + 60), showlegend: false,
      margin: { l: 62, r: 12, t: 10, b: 46 },
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
      font: { family: "system-ui, -apple-system, Segoe UI, Roboto, Noto Sans, sans-serif", size: width < 560 ? 11 : 12, color: ink },
      hoverlabel: { bgcolor: paper, bordercolor: faint, font: { color: ink }, align: "left" },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: faint, activecolor: ink },
      hovermode: "closest",
      // A finger that drags across a plot means to scroll the page.
      dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    };
  }

  const axis = (title, more) => ({
    title: { text: title, standoff: 8 }, gridcolor: theme().grid, linecolor: theme().faint, zeroline: false,
    ticks: "outside", tickcolor: theme().faint, showline: true, exponentformat: "power", ...more,
  });

  // Decades where there are many; 1, 2 and 5 where there are few.
  function logAxis(title, values) {
    const decades = values.length ? Math.log10(Math.max(...values) / Math.min(...values)) : 0;
    return axis(title, { type: "log", dtick: decades < 2.5 ? "D2" : Math.ceil(decades / 9) });
  }

  function show(plot, data, layout) {
    const config = { displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false, modeBarButtonsToRemove: ["toImage", "select2d", "lasso2d", "autoScale2d"] };
    Plotly.react(plot.canvas, data, layout, config);
    plot.drawn = true;
  }

  // The figure by itself, for a paper: dark on white whatever the screen shows, with its title and key inside.
  function figure(plot) {
    const article = plot.element.closest("article");
    const text = [article?.querySelector("h2, h3"), plot.element.querySelector("figcaption b")].map((part) => part?.textContent).filter(Boolean).join(": ");
    printing = true;
    draw(plot);
    const { data, layout } = plot.canvas, rows = Math.ceil(data.filter((line) => line.visible !== false).length / 3);
    const made = { data, layout: { ...layout, height: layout.height + 60 + 20 * rows, margin: { ...layout.margin, t: 40, b: layout.margin.b + 20 + 20 * rows },
      title: { text, font: { size: 14 } }, showlegend: true, legend: { orientation: "h", yref: "container", y: 0, yanchor: "bottom" },
      paper_bgcolor: LIGHT.paper, plot_bgcolor: LIGHT.paper } };
    printing = false;
    draw(plot);
    return made;
  }

  function save(plot) {
    const made = figure(plot), name = (plot.element.closest("article")?.id ?? "poinsot") + (plot.cost ? "-error" : "-motion");
    const { width, height } = made.layout;
    Plotly.downloadImage(made, { format: "svg", filename: name.replace(/[^\w.-]+/g, "-"), width, height });
  }

  // The key below a figure: a button for each curve, which shows or hides it.
  const SIGNS = { circle: "●", square: "■", diamond: "◆", "triangle-up": "▲", cross: "✚", x: "✖", "triangle-down": "▼", pentagon: "⬟", star: "★" };

  function button(text, click) {
    const made = document.createElement("button");
    Object.assign(made, { type: "button", textContent: text, onclick: click });
    return made;
  }

  function prepareKey(plot, entries) {
    plot.hidden = new Set(entries.filter((entry) => !entry.shown).map((entry) => entry.name));
    const choose = (names) => { plot.hidden = new Set(names); draw(plot); };
    plot.keys = entries.map(({ name, engine, symbol }) => {
      const key = button("", () => choose(plot.hidden.has(name) ? [...plot.hidden].filter((n) => n !== name) : [...plot.hidden, name]));
      const sign = document.createElement("span");
      sign.textContent = engine < 0 ? "━" : SIGNS[symbol];
      key.append(sign, " " + name);
      return { key, sign, name, engine };
    });
    const every = entries.map((entry) => entry.name);
    plot.element.querySelector(".keys").append(...plot.keys.map(({ key }) => key),
      button("show all", () => choose([])), button("hide all", () => choose(every)), button("save as SVG", () => save(plot)));
  }

  function refreshKey(plot) {
    plot.keys.forEach(({ key, sign, name, engine }) => {
      key.setAttribute("aria-pressed", !plot.hidden.has(name));
      sign.style.color = color(engine);
    });
  }

  // Error against run time or step.
  function picker(plot, name, options) {
    const label = document.createElement("label"), select = document.createElement("select");
    options.forEach((text) => select.add(new Option(text)));
    select.onchange = () => draw(plot);
    label.append(name + " ", select);
    plot.element.querySelector(".pick").append(label);
    return select;
  }

  function prepareCost(plot) {
    plot.element.querySelector(".pick").replaceChildren();
    plot.observable = picker(plot, "Error of", plot.spec.observables.map((each) => each.label));
    plot.against = picker(plot, "against", plot.spec.axes.map((each) => each.label));
    prepareKey(plot, plot.spec.lines.map(({ trace }) => ({ name: trace.name, engine: trace.meta, symbol: trace.marker.symbol, shown: true })));
  }

  // A scheme's errors where both axes have a place for them.
  function costTrace(plot, { trace, who, x, least, told }, errors, key, unit) {
    const drawn = errors.map((_, i) => i).filter((i) => errors[i] !== null && x[key][i] !== null);
    const place = (values) => drawn.map((i) => values[i]);
    const pace = (i) => least[i] ? `, ${(errors[i] / least[i] / 1e6).toExponential(2)} ${unit} each µs` : "";
    return {
      ...trace, x: place(x[key]), y: place(errors), customdata: drawn.map((i) => [...told[i], pace(i)]), visible: !plot.hidden.has(trace.name),
      line: { ...trace.line, color: color(trace.meta) }, marker: { ...trace.marker, color: color(trace.meta) },
      hovertemplate: `<b>${who}</b><br>dt %{customdata[0]} s, %{customdata[1]} steps<br>error %{y:.2e} ${unit}%{customdata[3]}<br>%{customdata[2]}<extra></extra>`,
    };
  }

  function drawCost(plot) {
    const { axes, lines, observables } = plot.spec, nth = plot.against.selectedIndex;
    const { errors, fronts, notes, title, unit } = observables[plot.observable.selectedIndex];
    const data = lines.map((line, k) => costTrace(plot, line, errors[k], axes[nth].key, unit)).filter((trace) => trace.x.length);
    const front = fronts[nth];
    // Beneath all curves, and wide: what no configuration beats both in error and in time.
    if (front) {
      data.unshift({ type: "scatter", mode: "lines", name: "Pareto front", ...front, hoverinfo: "skip", line: { color: theme().grid, width: 9, shape: "hv" } });
    }
    plot.element.querySelector(".view").textContent = (front ? "Grey band: the Pareto front, which nothing beats in both error and run time. " : "") + notes[nth];
    show(plot, data, {
      ...frame(plot, 400),
      xaxis: logAxis(axes[nth].title, data.flatMap((line) => line.x)), yaxis: logAxis(title, data.flatMap((line) => line.y)),
    });
  }

  // Pictures of motion.
  // Columns are fractions of their own range; those that run evenly from end to end are not in the data.
  function unpack({ n, low, high, even, data }) {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0)), view = new DataView(bytes.buffer);
    let at = 0;
    return low.map((start, k) => {
      const from = even.includes(k) ? -1 : 2 * n * at++;
      const part = (i) => (from < 0 ? i / Math.max(1, n - 1) : view.getUint16(from + 2 * i, true) / 65535);
      return Array.from({ length: n }, (_, i) => start + part(i) * (high[k] - start));
    });
  }

  function slider(plot, name, from, to, at) {
    const label = document.createElement("label"), input = document.createElement("input");
    Object.assign(input, { type: "range", min: from, max: to, value: at });
    input.oninput = () => draw(plot);
    label.append(name + " ", input);
    plot.element.querySelector(".pick").append(label);
    return input;
  }

  function prepareMotion(plot) {
    plot.spec.curves.forEach((curve) => { curve.columns = unpack(curve); });
    prepareKey(plot, plot.spec.curves);
    if (plot.spec.axes.length === 3) {
      plot.turn = slider(plot, "turn", -180, 180, 35);
      plot.tilt = slider(plot, "tilt", -90, 90, 35);
    }
  }

  // Orthographic view of (x, y, z), each already a fraction of the box, from azimuth and elevation.
  function projector(plot) {
    const a = (plot.turn.value * Math.PI) / 180, e = (plot.tilt.value * Math.PI) / 180;
    const [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
    return (x, y, z) => [ca * y - sa * x, ce * z - se * (ca * x + sa * y)];
  }

  function fractions(spec) {
    const [low, high] = spec.box;
    const extent = low.map((start, k) => high[k] - start), largest = Math.max(...extent) || 1;
    const size = extent.map((length) => (spec.equal || length === 0 ? largest : length));
    return (value, k) => (value - (low[k] + high[k]) / 2) / size[k];
  }

  // The edges of the box that the truth fills, each of its three directions named once.
  function boxLines(spec, fraction, project) {
    const [low, high] = spec.box, x = [], y = [], notes = [];
    const place = (parts) => project(...parts.map((part, k) => fraction(low[k] + part * (high[k] - low[k]), k)));
    for (let k = 0; k < 3; k++) {
      for (const [p, q] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
        const along = (part) => place([[part, p, q], [p, part, q], [p, q, part]][k]);
        const from = along(0), to = along(1);
        x.push(from[0], to[0], null);
        y.push(from[1], to[1], null);
      }
      const [u, v] = place([[0.5, 1, 0], [1, 0.5, 0], [1, 0, 0.5]][k]);
      notes.push({ x: 1.1 * u, y: 1.1 * v, text: spec.axes[k].split(" [")[0], showarrow: false, font: { color: theme().faint } });
    }
    return { x, y, notes };
  }

  function curveTrace(plot, curve, x, y) {
    const truth = curve.engine < 0, names = ["t [s]", ...plot.spec.axes];
    const columns = plot.spec.axes[0] === "t [s]" ? curve.columns.slice(1) : curve.columns;
    const text = columns[0].map((_, i) =>
      columns.map((c, k) => `${names[k + names.length - columns.length]} ${c[i].toPrecision(4)}`).join("<br>"));
    return {
      type: "scatter", name: curve.name, x, y, text, visible: !plot.hidden.has(curve.name),
      mode: truth ? "lines" : "markers", hovertemplate: `<b>${curve.name}</b><br>%{text}<extra></extra>`,
      line: { color: color(-1), width: 1.3 },
      marker: { color: color(curve.engine), symbol: curve.symbol, size: 5 },
    };
  }

  function drawMotion(plot) {
    const { spec } = plot, solid = spec.axes.length === 3;
    const fraction = fractions(spec), project = solid && projector(plot);
    // The truth is drawn last, over the dots.
    const data = [...spec.curves.slice(1), spec.curves[0]].map((curve) => {
      const axes = curve.columns.slice(1);
      if (!solid) return curveTrace(plot, curve, axes[0], axes[1]);
      const points = axes[0].map((_, i) => project(...axes.map((c, k) => fraction(c[i], k))));
      return curveTrace(plot, curve, points.map((p) => p[0]), points.map((p) => p[1]));
    });
    show(plot, data, solid ? solidLayout(plot, data, fraction, project) : flatLayout(plot, data));
  }

  function solidLayout(plot, data, fraction, project) {
    const { x, y, notes } = boxLines(plot.spec, fraction, project);
    data.unshift({ type: "scatter", mode: "lines", x, y, hoverinfo: "skip", showlegend: false, line: { color: theme().grid, width: 1 } });
    const reach = (values) => 1.25 * Math.max(...values.map(Math.abs), 0.3);
    const view = (values) => ({ visible: false, range: [-reach(values), reach(values)] });
    return { ...frame(plot, 380), annotations: notes, margin: { l: 8, r: 8, t: 8, b: 8 },
      xaxis: view(x), yaxis: { ...view(y), scaleanchor: "x" } };
  }

  function flatLayout(plot, data) {
    const range = [0, 1].map((k) => {
      const low = plot.spec.box[0][k], high = plot.spec.box[1][k], span = high - low;
      return span > 0 ? [low - 0.25 * span * (k || plot.spec.equal), high + 0.25 * span * (k || plot.spec.equal)] : [low - 1e-6, high + 1e-6];
    });
    const [across, up] = plot.spec.axes.map((title, k) => axis(title, { range: range[k] }));
    if (plot.spec.equal) up.scaleanchor = "x";
    return { ...frame(plot, plot.spec.equal ? 380 : 320), xaxis: across, yaxis: up };
  }

  // When to draw.
  const plots = [...document.querySelectorAll("figure.plot")].map((element) => ({
    element, canvas: element.querySelector(".canvas"), cost: element.classList.contains("cost"), drawn: false,
  }));

  function draw(plot) {
    if (!plot.spec) {
      plot.spec = JSON.parse(plot.element.querySelector("script").textContent);
      (plot.cost ? prepareCost : prepareMotion)(plot);
    }
    (plot.cost ? drawCost : drawMotion)(plot);
    refreshKey(plot);
  }

  const redraw = () => plots.filter((plot) => plot.drawn).forEach(draw);
  const seen = new IntersectionObserver((entries) => entries.filter((e) => e.isIntersecting).forEach((e) => {
    seen.unobserve(e.target);
    draw(plots.find((plot) => plot.element === e.target));
  }), { rootMargin: "300px" });
  plots.forEach((plot) => seen.observe(plot.element));

  // A phone's address bar comes and goes as one scrolls: only another width is another size.
  let pause, width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(pause);
    pause = setTimeout(() => printing || redraw(), 150);
  });
  dark.addEventListener("change", redraw);
  addEventListener("beforeprint", () => { printing = true; plots.forEach(draw); });
  addEventListener("afterprint", () => { printing = false; redraw(); });

  // Tables: a link from the matrix opens the one it leads to.
  function openTarget() {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (target && target.tagName === "DETAILS") { target.open = true; target.scrollIntoView(); }
  }
  addEventListener("hashchange", openTarget);
  openTarget();
  document.querySelectorAll("button[data-open]").forEach((button) => {
    button.onclick = () => document.querySelectorAll("details").forEach((d) => { d.open = Boolean(button.dataset.open); });
  });
})();
