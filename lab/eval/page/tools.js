// Building blocks of the sections: numbers, tables and drawings.
'use strict';
const report = JSON.parse(document.getElementById('report').textContent);
const systems = Object.entries(report.systems);
const MEASURES = report.measures;
const DASH = '\u2013';

// Formats numbers. Missing values are null, shown as a dash.
const isNumber = (value) => typeof value === 'number';
const fixed = (value, digits) => {
  if (!isNumber(value)) return DASH;
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace('-', '') : text;
};
const count = (value) => (value ? value.toLocaleString('en-US') : DASH);
const kilobytes = (bytes) => (bytes ? `${count(Math.floor((bytes + 512) / 1024))} KB` : DASH);
const duration = (seconds) => {
  if (!isNumber(seconds)) return DASH;
  const whole = Math.round(seconds);
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min ${whole % 60} s`;
};
const plural = (n, what) => `${n} ${what}${n === 1 ? '' : 's'}`;

// Elements. Children are nodes or strings, which need no escaping.
function make(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== '') node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}
const paragraph = (text, cssClass) => make('p', { class: cssClass }, text);
const details = (title, ...body) =>
  body.some(Boolean) ? make('details', {}, make('summary', {}, title), ...body.filter(Boolean)) : null;

// Marks the best of several values as printed; none if there are fewer than two.
function bestOf(values, better, digits) {
  const shortfall = { higher: (v) => -v, lower: (v) => v, nearest_one: (v) => Math.abs(v - 1) }[better];
  const measured = values.filter(isNumber);
  if (measured.length < 2 || !shortfall) return values.map(() => false);
  const min = measured.reduce((a, b) => (shortfall(b) < shortfall(a) ? b : a));
  return values.map((value) => isNumber(value) && fixed(value, digits) === fixed(min, digits));
}

// A table cell: `share`, 0 to 1, is the length of the bar below the number.
const cell = (text, { best = false, share } = {}) => ({ text, best, share });
const number = (value, digits) => cell(fixed(value, digits));
const share = (value, digits) => cell(fixed(value, digits), { share: value ?? undefined });

// groups: [{ label, columns: [label] }]; rows: [{ name, cells, apart }]. Null without rows or columns.
function table(names, groups, rows, caption) {
  groups = groups.filter((group) => group.columns.length);
  if (!rows.length || !groups.length) return null;
  const grouped = groups.some((group) => group.label);
  const firsts = groups.flatMap((group) => group.columns.map((_, i) => (i === 0 ? 'first' : '')));
  const labels = groups.flatMap((group) => group.columns);
  const corner = make('th', { scope: 'col', rowspan: grouped ? 2 : '' }, names);
  const headings = groups.map((group) => make(
    'th', { scope: 'colgroup', class: 'group first', colspan: group.columns.length }, group.label));
  const columns = labels.map((label, i) => make('th', { scope: 'col', class: firsts[i] }, label));
  const head = grouped ? [make('tr', {}, corner, ...headings), make('tr', {}, ...columns)]
    : [make('tr', {}, corner, ...columns)];
  const body = rows.map((row) => make(
    'tr', { class: row.apart ? 'apart' : '' },
    make('th', { scope: 'row', class: [...row.name].length > 36 ? 'long' : '' }, row.name),
    ...row.cells.map(({ text, best, share: bar }, i) => make('td', {
      class: [firsts[i], isNumber(bar) ? 'share' : ''].filter(Boolean).join(' '),
      style: isNumber(bar) ? `--share:${(100 * Math.min(Math.max(bar, 0), 1)).toFixed(1)}%` : '',
    }, best ? make('b', {}, `\u2022 ${text}`) : text))));
  return make('div', { class: 'table' }, make(
    'table', {}, ...(caption ? [make('caption', {}, caption)] : []),
    make('thead', {}, ...head), make('tbody', {}, ...body)));
}

// Tables of measures. A source is { name, of: { row: metrics }, competes }.
const measureCell = (measure, value, best) =>
  cell(fixed(value, measure.digits), { best, share: measure.better === 'higher' ? value ?? undefined : undefined });
const namesOf = (tables, order) => {
  const known = new Set(tables.flatMap((of) => Object.keys(of)));
  return [...order.filter((name) => known.delete(name)), ...[...known].sort()];
};
function metricsMatrix(rowsAre, rows, sources, keys, lastRow) {
  const groups = keys.map((key) => {
    const measure = MEASURES.find((one) => one.key === key);
    const shown = sources.filter((source) => Object.values(source.of).some((of) => isNumber(of[key])));
    return { measure, shown, label: measure.label, columns: shown.map((source) => source.name) };
  }).filter((group) => group.shown.length);
  const row = (name, apart) => ({
    name, apart, cells: groups.flatMap(({ measure, shown }) => {
      const values = shown.map((source) => source.of[name]?.[measure.key] ?? null);
      const best = bestOf(values.map((v, i) => (shown[i].competes ? v : null)), measure.better, measure.digits);
      return values.map((value, i) => measureCell(measure, value, best[i]));
    }),
  });
  return table(rowsAre, groups, [...rows.map((name) => row(name)), ...(lastRow ? [row(lastRow, true)] : [])]);
}
const allColumns = [{ label: '', columns: ['takes', 'windows', ...MEASURES.map((measure) => measure.label)] }];
const allCells = (of, best = []) => [
  cell(count(of.takes)), cell(count(of.windows)),
  ...MEASURES.map((measure, m) => measureCell(measure, of[measure.key], best[m]))];
function byName(rowsAre, order, real, input, key) {
  const tables = systems.map(([, system]) => system[key]);
  if (!namesOf(tables, order).length) return [];
  const sources = [{ name: 'real', of: real }, ...(input ? [{ name: 'input', of: input }] : []),
    ...systems.map(([name, system]) => ({ name, of: system[key], competes: true }))];
  const rows = namesOf([...tables, real], order);
  return [
    metricsMatrix(rowsAre, rows, sources, ['style_accuracy', 'content_accuracy']),
    metricsMatrix(rowsAre, rows, sources, ['jerk_ratio', 'skating_ratio', 'pose_error_deg']),
    ...systems.map(([name, system]) => details(`All numbers of ${name}`, table(
      rowsAre, allColumns, namesOf([system[key]], order).map((row) => ({ name: row, cells: allCells(system[key][row]) }))))),
  ];
}

// Drawings.
const COLOURS = ['#0072b2', '#d55e00', '#009e73', '#aa3377', '#56a4d9', '#c99700', '#555555'];
const colour = (i) => COLOURS[i % COLOURS.length];
const tinted = (hex, amount) => `#${[1, 3, 5].map((at) => {
  const from = parseInt(hex.slice(at, at + 2), 16);
  return Math.round(from + (255 - from) * amount).toString(16).padStart(2, '0');
}).join('')}`;
const measuring = document.createElement('canvas').getContext('2d');
const textWidth = (text, size) => {
  measuring.font = `${size}px sans-serif`;
  return measuring.measureText(text).width;
};
function shape(name, attributes, text) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}
const line = (x1, y1, x2, y2, stroke, width = 1) => shape('line', { x1, y1, x2, y2, stroke, 'stroke-width': width });
const rect = (x, y, width, height, fill, rx = 0) => shape('rect', { x, y, width, height, fill, rx });
const label = (x, y, text, size, { fill = '#222222', anchor = 'start', bold = false, up = false } = {}) =>
  shape('text', { x, y, fill, 'font-size': size, 'text-anchor': anchor, 'font-weight': bold ? 600 : 400,
    ...(up ? { transform: `rotate(-90 ${x} ${y})` } : {}) }, text);
function drawing(what, width, height, shapes, fullWidth) {
  const svg = shape('svg', { viewBox: `0 0 ${width} ${height}`, width, height, role: 'img', 'aria-label': what });
  svg.append(...shapes);
  return make('figure', { class: fullWidth ? 'wide' : 'plot' }, svg);
}
function ticksOf(low, high, about) {
  const raw = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const factor = raw / power;
  const step = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  const first = Math.floor(low / step + 1e-9), last = Math.ceil(high / step - 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}
const widened = (values) => {
  const low = Math.min(...values), high = Math.max(...values);
  const room = low < high ? 0 : Math.abs(low) * 0.1 || 1;
  return [low - room, high + room];
};
// curves: [{ name, points: [[x, y]], colour }].
function plot(title, xLabel, yLabel, curves) {
  const width = 760, height = 440, right = width - 26, bottom = height - 58;
  const [low, high] = widened(curves.flatMap(({ points }) => points.map(([x]) => x)));
  const yTicks = ticksOf(...widened(curves.flatMap(({ points }) => points.map(([, y]) => y))), 6);
  const text = (value) => String(Number(value.toPrecision(6)));
  const left = 40 + Math.max(...yTicks.map((tick) => textWidth(text(tick), 12)));
  const shapes = [label(left, 30, title, 17, { bold: true })];
  let x = left, y = 56;
  for (const { name, colour: ink } of curves) {  // The legend.
    const needed = 34 + textWidth(name, 13) + 22;
    if (x > left && x + needed > right) { x = left; y += 20; }
    shapes.push(line(x, y - 4, x + 24, y - 4, ink, 2.5), label(x + 32, y, name, 13));
    x += needed;
  }
  const top = y + 18;
  const atX = (v) => left + (v - low) / (high - low) * (right - left);
  const atY = (v) => bottom - (v - yTicks[0]) / (yTicks.at(-1) - yTicks[0]) * (bottom - top);
  for (const tick of yTicks) {
    shapes.push(line(left, atY(tick), right, atY(tick), '#e6e6e6'),
      label(left - 8, atY(tick) + 4, text(tick), 12, { fill: '#666666', anchor: 'end' }));
  }
  shapes.push(line(left, bottom, right, bottom, '#999999', 1.2));
  for (const tick of ticksOf(low, high, 8).filter((v) => v >= low - 1e-9 && v <= high + 1e-9)) {
    shapes.push(line(atX(tick), bottom, atX(tick), bottom + 5, '#999999', 1.2),
      label(atX(tick), bottom + 20, text(tick), 12, { fill: '#666666', anchor: 'middle' }));
  }
  shapes.push(label((left + right) / 2, height - 14, xLabel, 13, { anchor: 'middle' }),
    label(20, (top + bottom) / 2, yLabel, 13, { anchor: 'middle', up: true }));
  for (const { points, colour: ink } of curves) {
    shapes.push(shape('polyline', { points: points.map(([a, b]) => `${atX(a)},${atY(b)}`).join(' '),
      fill: 'none', stroke: ink, 'stroke-width': 2.2 }));
    if (points.length < 40) {
      shapes.push(...points.map(([a, b]) => shape('circle', { cx: atX(a), cy: atY(b), r: 3, fill: ink })));
    }
  }
  return drawing(`${title} over ${xLabel}`, width, height, shapes);
}
