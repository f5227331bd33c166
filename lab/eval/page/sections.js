// The sections of the page; each is empty if the report has no data for it.
function evaluated() {
  const withFloor = (value, floor) => `${fixed(value, 3)} (usual: at least ${fixed(floor, 3)})`;
  const joined = (names) => names.join(', ') || DASH;
  const facts = [
    ['Evaluated on', joined(report.tested_on)], ['Trained on', joined(report.trained_on)],
    ['Real takes', `${count(report.real.takes)} held out, ${count(report.real.windows)} windows`],
    ['Styles', joined(report.styles)], ['Contents', joined(report.contents)],
    ['Style classifier on real takes', withFloor(report.real.style_accuracy, report.style_floor)],
    ['Content classifier on real takes', withFloor(report.real.content_accuracy, report.content_floor)],
    ...systems.filter(([, { recorded }]) => recorded).map(([name, { recorded }]) =>
      [`Recorded outputs of ${name}`, `${recorded.judged} of ${recorded.listed} judged`]),
    ['Time taken', duration(report.seconds)],
  ];
  return [
    make('dl', { class: 'facts' }, ...facts.flatMap(([term, text]) => [make('dt', {}, term), make('dd', {}, text)])),
    ...report.notes.map((note) => paragraph(note, 'warning'))];
}

function overall() {
  if (!systems.length && !report.real.takes) return [];
  const best = MEASURES.map(({ key, better, digits }) =>
    bestOf(systems.map(([, system]) => system.seen[key]), better, digits));
  return [table('', allColumns, [
    { name: 'real takes', cells: allCells(report.real) }, { name: 'input', cells: allCells(report.input) },
    ...systems.map(([name, system], s) =>
      ({ name, cells: allCells(system.seen, best.map((of) => of[s])), apart: s === 0 }))])];
}

// Whole clips, classified by performer.
const COLUMNS = {
  clips: (of) => cell(of?.clips ? String(of.clips) : DASH),
  recognised: (of) => share(of?.recognised, 2),
  'of real': (of) => number(of?.of_real, 2),
  cm: (of) => number(of?.cm, 1),
  "hands' speed": (of) => number(of?.hand_speed, 2),
  "hands' sharpness": (of) => number(of?.hand_sharpness, 2),
};
// sources: [{ name, of, columns }], of: one of the JSON's groups of clips.
function clipsTable(rowsAre, key, sources, caption) {
  const names = [...new Set(sources.flatMap(({ of }) => Object.keys(of[key])))].sort();
  const cells = (pick) => sources.flatMap(({ of, columns }) => columns.map((column) => COLUMNS[column](pick(of))));
  return names.length ? table(
    rowsAre, sources.map(({ name, columns }) => ({ label: name, columns })),
    [...names.map((name) => ({ name, cells: cells((of) => of[key][name]) })),
      { name: 'all styles', cells: cells((of) => of.all), apart: true }], caption) : null;
}
// Rows: the requested style; columns: the recognised style. A square's darkness is its share of the
// row; its number is the count of clips.
function confusion(name, counts) {
  const labels = report.performers.labels, side = 17, gap = 5;
  const margin = Math.max(...labels.map((text) => textWidth(text, 11))) + 2 * gap;
  const shapes = labels.flatMap((text, i) => {
    const at = margin + side * i, base = at + side / 2 + 11 / 3, end = margin + side * labels.length;
    return [line(margin, at, end, at, '#e4e8ec', 0.5), line(at, margin, at, end, '#e4e8ec', 0.5),
      label(margin - gap, base, text, 11, { anchor: 'end' }), label(base, margin - gap, text, 11, { up: true })];
  });
  for (const [asked, row] of Object.entries(counts)) {
    const all = Object.values(row).reduce((a, b) => a + b, 0);
    for (const [taken, clips] of Object.entries(row)) {
      const x = margin + side * labels.indexOf(taken), y = margin + side * labels.indexOf(asked);
      shapes.push(
        rect(x + 0.5, y + 0.5, side - 1, side - 1,
          tinted(asked === taken ? '#0065a3' : '#b3541e', 0.85 * (1 - clips / all))),
        label(x + side / 2, y + side / 2 + 3.2, String(clips), 9,
          { fill: clips / all > 0.5 ? '#ffffff' : '#333333', anchor: 'middle' }));
    }
  }
  const size = margin + side * labels.length + gap;
  return [make('h3', {}, `What clips are taken for: ${name}`),
    drawing(`Confusion of styles, ${name}`, size, size, shapes, true)];
}
function performers() {
  const few = ['clips', 'recognised'], { own, across, shared } = report.performers;
  const first = clipsTable('style', 'by_style', [
    { name: 'real takes', of: own, columns: [...few, 'cm'] },
    ...systems.map(([name, system]) =>
      ({ name, of: system.performers.own, columns: [...few, 'of real', 'cm'] }))],
  'Share of clips recognised, and distance from the nearest real take');
  if (!first) return [];
  const second = systems.some(([, system]) => system.performers.across.all.clips) && clipsTable('style', 'by_style', [
    { name: 'real takes', of: across, columns: few }, { name: 'own judge: real takes', of: shared, columns: few },
    ...systems.flatMap(([name, system]) => [
      { name, of: system.performers.across, columns: few },
      { name: `own judge: ${name}`, of: system.performers.shared, columns: few }])],
  "Motion of other performers: before the judge of the style's performer, and of shared styles before their own");
  return [first, second, paragraph(
    'A row of a drawing is the style that was asked for, or that a real take shows; a column is ' +
    'what clips are taken for. Styles of one performer stand together.'),
  ...confusion('real takes', own.confusion),
  ...systems.filter(([, system]) => system.performers.own.all.clips).flatMap(([name, system]) =>
    confusion(name, system.performers.own.confusion))];
}

function strength() {
  const keys = [...new Set(systems.flatMap(([, system]) => Object.keys(system.strength)))]
    .sort((a, b) => Number(a) - Number(b));
  if (!keys.length) return [];
  const curves = (key) => {
    const made = systems.map(([name, system], s) => ({
      name, colour: colour(s),
      points: keys.map((at) => [Number(at), system.strength[at]?.[key]]).filter(([, value]) => isNumber(value)),
    })).filter(({ points }) => points.length);
    const strengths = made.flatMap(({ points }) => points.map(([x]) => x)), real = report.real[key];
    return !made.length || !isNumber(real) ? made : [...made, { name: 'real takes', colour: '#8a8a8a',
      points: [[Math.min(...strengths), real], [Math.max(...strengths), real]] }];
  };
  const plots = [['Style recognised', 'share of windows', 'style_accuracy'],
    ['Content kept', 'share of windows', 'content_accuracy'], ['Jerk', 'ratio to real takes', 'jerk_ratio'],
    ['Distance from the input', 'cm', 'distance_cm']]
    .map(([title, unit, key]) => [title, unit, curves(key)]).filter(([, , made]) => made.length)
    .map(([title, unit, made]) => plot(title, 'strength', unit, made));
  const sliders = systems.filter(([, { slider }]) => isNumber(slider.style) || isNumber(slider.distance));
  return [
    plots.length && make('div', { class: 'plots' }, ...plots),
    table('', [{ label: 'rank correlation of strength with', columns: ['style, 0 to 1', 'distance, 0 to 2'] }],
      sliders.map(([name, { slider }]) => ({ name, cells: [number(slider.style, 3), number(slider.distance, 3)] }))),
    details('The numbers of the curves', metricsMatrix('strength', keys,
      systems.map(([name, system]) => ({ name, of: system.strength })),
      ['style_accuracy', 'content_accuracy', 'jerk_ratio', 'distance_cm']))];
}

function mixes() {
  const with_ = systems.filter(([, system]) => system.mixes.length);
  const key = (mix) => `${mix.first} + ${mix.second}`;
  const pairs = [...new Set(with_.flatMap(([, system]) => system.mixes.map(key)))];
  return [table('half and half',
    with_.map(([name]) => ({ label: name, columns: ['either style', 'content', 'correlation'] })),
    pairs.map((name) => ({ name, cells: with_.flatMap(([, system]) => {
      const mix = system.mixes.find((one) => key(one) === name);
      return [share(mix?.either, 3), share(mix?.content, 3), number(mix?.correlation, 3)];
    }) })))];
}

function unseen() {
  const first = ['style_accuracy', 'content_accuracy', 'jerk_ratio', 'pose_error_deg'];
  const others = MEASURES.map(({ key }) => key).filter((key) => !first.includes(key));
  const many = ['clips', 'recognised', 'of real', 'cm', "hands' speed", "hands' sharpness"];
  return systems.flatMap(([name, system]) => Object.entries(system.unseen_splits).flatMap(([split, of]) => {
    const mean = 'mean of these', { performers: clips, means } = of;
    const contents = namesOf([Object.fromEntries(of.contents.map((content) => [content, 0]))], report.contents);
    const sources = [{ name: 'unseen', of: { ...of, [mean]: of.mean } },
      { name: 'seen', of: { ...of.seen, [mean]: means.seen } },
      { name: 'real, blind', of: { ...of.blind, [mean]: means.blind } },
      { name: 'mean posture', of: { ...of.mean_posture, [mean]: means.mean_posture } }];
    sources[0].of = Object.fromEntries([...contents, mean].map((content) => [content, sources[0].of[content]]));
    const matrix = metricsMatrix('content', contents, sources, first, mean);
    return matrix ? [make('h3', {}, `${name}, split ${split}`), matrix,
      details(`All other numbers of split ${split}`, metricsMatrix('content', contents, sources, others, mean)),
      clipsTable('content', 'by_content', [
        { name: 'unseen', of: clips.unseen, columns: many },
        { name: 'mean posture', of: clips.mean_posture, columns: many },
        { name: 'real takes', of: clips.real, columns: ['clips', 'recognised', 'cm'] },
        { name: 'real, blind', of: clips.blind, columns: ['clips', 'recognised'] }],
      'Whole clips before the judges of their performers')] : [];
  }));
}

function foreign() {
  const with_ = systems.filter(([, system]) => system.foreign.rows.length);
  if (!with_.length) return [];
  const rows = (of) => with_.map(([name, system]) => ({ name, cells: of(system.foreign) }));
  const summary = table('', [
    { label: '', columns: ['clips', 'pairs'] }, { label: 'jerk / input', columns: ['median', '90%', 'largest'] },
    { label: 'velocity correlation', columns: ['median', 'lowest 10%'] }, { label: 'moved cm', columns: ['mean'] },
    { label: 'beyond limits', columns: ['frames', 'worst pair', 'pairs'] },
    { label: 'under the floor', columns: ['frames', 'worst pair', 'pairs'] },
    { label: 'jumps', columns: ['frames', 'pairs'] }, { label: 'skating', columns: ['output', 'input'] },
    { label: 'turned deg', columns: ['mean'] }, { label: 'drift m', columns: ['largest'] },
    { label: 'gate', columns: ['mean'] }], rows(({ summary: of }) => [
    cell(count(of.clips)), cell(count(of.rows)),
    number(of.jerk_ratio.median, 2), number(of.jerk_ratio.p90, 2), number(of.jerk_ratio.max, 2),
    number(of.velocity_correlation.median, 3), number(of.velocity_correlation.p10, 3), number(of.distance_cm.mean, 2),
    ...[of.beyond_limits, of.under_floor].flatMap((part) =>
      [number(part.mean, 4), number(part.max, 4), number(part.rows, 0)]),
    number(of.jumps.frames, 0), number(of.jumps.rows, 0),
    number(of.skating_ratio.mean, 3), number(of.input_skating_ratio.mean, 3),
    number(of.turned_deg.mean, 1), number(of.drift_m.max, 2), number(of.gate.mean, 3)]));
  const shares = (of) => ['style_robust', 'style_lda', 'forced_mlp', 'forced_lda', 'signature_sign',
    'signature_amount'].map((key) => share(of[key], 3));
  const { real, real_unseen: realUnseen, input } = report.foreign_reference;
  const styles = table('', [{ label: 'style recognised by', columns: ['networks', 'LDA'] },
    { label: 'chosen among all styles by', columns: ['networks', 'LDA'] },
    { label: 'signature', columns: ['right sign', 'right amount'] }], [
    { name: 'real takes', cells: shares(real) }, { name: 'real takes of unseen actions', cells: shares(realUnseen) },
    ...rows(({ summary: of }) => shares(of)), { name: 'input', cells: shares(input), apart: true }]);
  const shots = with_.map(([name, { foreign: { shot } }]) => table('', [
    { label: 'cm; turn in degrees', columns: ['frames', 'median', '90%', 'above 2'] }],
  Object.entries(shot).map(([key, of]) => ({ name: key.replaceAll('_', ' '), cells: [
    cell(count(of.frames)), number(of.median, 1), number(of.p90, 1), share(of.over_2, 3)] })),
  `Feet, seats and hands against the input, ${name}`));
  return [summary, styles, ...shots, ...with_.map(signatures), ...with_.flatMap(worst),
    details('Clip by clip, means over the styles', clipByClip(with_))];
}
// The changes of a style, in real takes and in a system's outputs. The longest bar is the maximum
// of a column; a dash is a trait on which real takes disagree.
function signatures([name, system]) {
  const made = system.foreign.signatures;
  const styles = Object.keys(report.signatures).filter((style) => made[style]);
  const largest = ({ key }) => Math.max(1e-9, ...Object.values(report.signatures).concat(Object.values(made))
    .map((of) => Math.abs(of[key] ?? 0)));
  const bar = (value, max) => cell(fixed(value, 1), { share: isNumber(value) ? Math.abs(value) / max : undefined });
  return table('style', [
    ...report.traits.map((trait) => ({ label: trait.label, columns: ['real', name] })),
    { label: 'outputs', columns: ['right sign', 'right amount'] },
    { label: 'real, left out', columns: ['right sign', 'right amount'] }],
  styles.map((style) => {
    const of = report.signatures[style], out = made[style];
    return { name: style, cells: [
      ...report.traits.flatMap((trait) => [of, out].map((one) => bar(one[trait.key], largest(trait)))),
      share(out.sign, 2), share(out.amount, 2), share(of.left_out_sign, 2), share(of.left_out_amount, 2)] };
  }), `Signatures: what a style changes, in real takes and in the outputs of ${name}`);
}
function worst([name, system]) {
  const columns = ['jerk / input', 'velocity correlation', 'moved cm', 'beyond limits', 'under the floor', 'jumps',
    'skating', 'of the input', 'turned deg', 'drift m', 'gate'];
  const rows = (better, caption) => table('clip, style', [{ label: '', columns }],
    [...system.foreign.rows].sort(better).slice(0, 8).map((row) => ({
      name: `${row.clip}, ${row.style}`, cells: [
        number(row.jerk_ratio, 2), number(row.velocity_correlation, 3), number(row.distance_cm, 2),
        number(row.beyond_limits, 3), number(row.under_floor, 3), number(row.jumps, 0), number(row.skating_ratio, 3),
        number(row.input_skating_ratio, 3), number(row.turned_deg, 1), number(row.drift_m, 2), number(row.gate, 3)],
    })), caption);
  return [make('h3', {}, `Worst of ${name}`),
    rows((a, b) => b.jerk_ratio - a.jerk_ratio, 'Most jerk against the input'),
    rows((a, b) => a.velocity_correlation - b.velocity_correlation,
      'Least like the input in how hands and feet move')];
}
function clipByClip(with_) {
  const columns = [['jerk / input', 'jerk_ratio', 2], ['velocity correlation', 'velocity_correlation', 3],
    ['moved cm', 'distance_cm', 2], ['under the floor', 'under_floor', 3], ['gate', 'gate', 3]];
  const clips = [...new Set(with_.flatMap(([, system]) => Object.keys(system.foreign.by_clip)))];
  return table('clip', columns.map(([title]) => ({ label: title, columns: with_.map(([name]) => name) })),
    clips.map((name) => ({ name, cells: columns.flatMap(([, key, digits]) =>
      with_.map(([, system]) => number(system.foreign.by_clip[name]?.[key], digits))) })));
}

function disturbances() {
  const with_ = systems.filter(([, system]) => Object.keys(system.disturbances).length);
  const names = [...new Set(with_.flatMap(([, system]) => Object.keys(system.disturbances)))];
  return [table('disturbance', [{ label: 'pose error cm', columns: with_.map(([name]) => name) }],
    names.map((name) => {
      const values = with_.map(([, system]) => system.disturbances[name]?.cm ?? null);
      const best = bestOf(values, 'lower', 2);
      return { name, cells: values.map((value, s) => cell(fixed(value, 2), { best: best[s] })) };
    }))];
}

// How much of the styles' movement and side arrives on walks, each share of the real change.
function arrival() {
  const WALKS = [['real', 'real takes'], ['own', "the performer's walks"], ['others', "other people's walks"],
    ['walker', "the walker's"]];
  return systems.flatMap(([name, system]) => {
    const of = system.arrival, styles = Object.entries(of.by_style);
    if (!styles.length) return [];
    const traits = Object.keys(of.real.by_trait);
    const columns = [...traits.map((trait) => trait.replaceAll('_', ' ')), 'side', 'steps a second'];
    return [
      table('walks', [{ label: 'movement', columns: ['median', 'below half', 'wrong sign', ...columns.slice(0, -2)] },
        { label: '', columns: ['side', 'styles in step'] }],
      WALKS.map(([key, label]) => ({ name: label, cells: [
        number(of[key].median, 2), number(of[key].below_half, 2), number(of[key].wrong_sign, 2),
        ...traits.map((trait) => number(of[key].by_trait[trait], 2)),
        number(of[key].side, 2), cell(String(of[key].styles_in_step))] })), name),
      table('style', WALKS.slice(1).map(([, label]) => ({ label, columns })), styles.map(([style, found]) => ({
        name: style,
        cells: WALKS.slice(1).flatMap(([key]) => [...traits.map((trait) => number(found[key].movement[trait], 2)),
          number(found[key].side, 2), number(found[key].steps, 1)]) })), name)];
  });
}

function foresight() {
  return systems.map(([name, system]) => {
    const rows = Object.entries(system.foresight);
    const times = rows.length ? Object.keys(rows[0][1]).filter((key) => key !== 'instants') : [];
    return table('content', times.map((seconds) =>
      ({ label: `${seconds} s ahead, cm`, columns: ['predicted', 'velocity', 'held'] })),
    rows.map(([content, of]) => ({ name: content, cells: times.flatMap((seconds) => {
      const values = [of[seconds].predicted_cm, of[seconds].velocity_cm, of[seconds].held_cm];
      const best = bestOf(values, 'lower', 2);
      return values.map((value, i) => cell(fixed(value, 2), { best: best[i] }));
    }) })), name);
  });
}

function persons() {
  return systems.flatMap(([name, { persons }]) => {
    if (!persons) return [];
    const { real, seeds, styled, others } = persons;
    const apart = (of) => [number(of.median_cm, 2), number(of.p90_cm, 2), number(of.told, 3)];
    return [
      table('persons', [{ label: 'apart, cm', columns: ['median', '90 %'] }, { label: '', columns: ['told'] }],
        [{ name: `${real.people} real people`, cells: apart(real) },
          { name: plural(seeds.seeds, 'seed'), cells: apart(seeds) }], name),
      table('of them', [{ label: '', columns: ['seeds outside 95 % of people', 'styles told with a person', 'without'] },
        { label: 'on other motion', columns: ['jerk', '90 %', 'beyond limits', 'jumps'] }],
      [{ name: 'seeds', cells: [number(seeds.outside, 3), number(styled.told, 3), number(styled.told_without, 3),
        number(others.jerk_median, 2), number(others.jerk_p90, 2), number(others.beyond_limits, 4),
        number(others.jumps, 3)] }], name)];
  });
}

function contacts() {
  return report.contacts.map(({ title, rows }) => {
    const longest = Math.max(...rows.map(({ frames, fps }) => frames / fps));
    if (!(longest > 0)) return null;
    const width = 860, margin = 16, top = 34, height = 9, gap = 4, rowHeight = 36;
    const left = margin + Math.min(width / 3, Math.max(...rows.map((row) => textWidth(row.label, 13) * 1.1))) + 52;
    const scale = (width - 24 - left) / longest, bottom = top + rowHeight * rows.length;
    const shapes = [label(margin, 22, title, 15, { bold: true })];
    for (const tick of ticksOf(0, longest, 8).filter((seconds) => seconds <= longest * (1 + 1e-9))) {
      shapes.push(line(left + tick * scale, top, left + tick * scale, bottom, '#e6e6e6'),
        label(left + tick * scale, bottom + 18, `${Number(tick.toPrecision(6))} s`, 12,
          { fill: '#666666', anchor: 'middle' }));
    }
    rows.forEach((row, r) => {
      const y = top + rowHeight * r + 7;
      shapes.push(label(margin, y + height + gap / 2 + 4.5, row.label, 13, { bold: true }));
      ['left', 'right'].forEach((foot, f) => {
        const at = y + f * (height + gap), frame = scale / row.fps;
        shapes.push(label(left - 8, at + height - 1, foot, 11, { fill: '#666666', anchor: 'end' }),
          rect(left, at, row.frames * frame, height, '#f1f1f1', 2),
          // The left side is lighter, as in the stick figures.
          ...row[foot].map(([first, end]) => rect(left + first * frame, at, (end - first) * frame, height,
            tinted(colour(r), f === 0 ? 0.52 : 0), 2)));
      });
    });
    return drawing(`When the feet are planted: ${title}`, width, bottom + 40, shapes);
  });
}

function literature() {
  const measured = systems.filter(([, system]) => isNumber(system.cc) || isNumber(system.sc));
  if (!measured.length) return [];
  const best = ['cc', 'sc'].map((key) => bestOf(measured.map(([, system]) => system[key]), 'lower', 2));
  const floor = isNumber(report.cc_floor) || isNumber(report.sc_floor) ? [{
    name: 'real takes against real takes', cells: [number(report.cc_floor, 2), number(report.sc_floor, 2)] }] : [];
  return [table('', [{ label: '', columns: ['CC', 'SC++'] }], [...floor, ...measured.map(([name, system], s) => ({
    name, apart: s === 0, cells: [cell(fixed(system.cc, 2), { best: best[0][s] }),
      cell(fixed(system.sc, 2), { best: best[1][s] })] }))])];
}

function cost() {
  const any = systems.some(([, of]) => [of.step_us, of.bone_length_error_cm, of.model_bytes, of.parameters]
    .some(isNumber));
  return any ? [table('', [{ label: '', columns:
    ['recipe', 'step \u00b5s', 'model', 'parameters', 'bone length error cm'] }],
  systems.map(([name, of]) => ({ name, cells: [cell(of.recipe ?? DASH), number(of.step_us, 2),
    cell(kilobytes(of.model_bytes)), cell(count(of.parameters)), number(of.bone_length_error_cm, 4)] })))] : [];
}

const DEFINITIONS = [
  ['takes, windows', 'How many takes were evaluated, and how many windows they have.'],
  ['judge of a performer',
    "Tells one performer's styles and neutral motion apart, from this performer's training takes alone, in " +
    'windows of two seconds; a clip is taken for what most of its windows are.'],
  ['recognised, of real',
    'Share of clips taken for the style asked for, and the same divided by the share of real held-out takes.'],
  ['cm beside recognised',
    'Mean distance of the joints in the body frame from the nearest real take of that style, action and ' +
    'performer, warped in time; of real held-out takes from training takes.'],
  ["hands' speed, hands' sharpness",
    'Mean speed of the hands, and their jerk per speed, divided by those of the real takes.'],
  ['unseen, seen',
    'Results on contents whose styled takes were left out of training, and of the same system trained with ' +
    'them.'],
  ['real, blind',
    'Real styled takes of the unseen contents, classified by classifiers that were not trained on these ' +
    'contents: an upper bound.'],
  ['mean posture',
    "The style's mean change of posture and tempo over its training pairs, for any motion: the simplest " +
    'transfer.'],
  ['jerk / input', 'Mean jerk of the joints against that of the input; 1 is as smooth as the input.'],
  ['velocity correlation',
    "Correlation of the velocities of hands and feet, in the body frame, with the input's; 1 is the same " +
    'motion.'],
  ['beyond limits', "Share of frames with a joint outside human limits, less the input's own."],
  ['under the floor', 'Share of frames with a toe 3 cm lower than both the floor and the input.'],
  ['jumps', 'Frames in which a joint jumps by more than 6 cm that the input lacks.'],
  ['pairs', 'A pair is an out-of-distribution clip in a style.'],
  ['drift', 'Distance between the final hip positions of output and input on the ground.'],
  ['gate', 'Share of the dynamic change that the gate lets through: 1 all, 0 posture only.'],
  ['pose error under a disturbance',
    'The error in cm above, when only the input windows of the system are disturbed.'],
  ['rank correlation',
    "Spearman's correlation of the strengths up to 1 with the style's probability, and up to 2 with the " +
    'distance from the input; 1 if more strength always does more.'],
  ['either style, correlation',
    'Of a mix of two styles: share of windows recognised as one of the two, and correlation of the share of ' +
    'the second with how much more probable it is than the first.'],
  ['CC',
    "Distance of the output from the input when the asked style is the input's own: every second frame, 21 " +
    'joints, file units, summed over joints, mean over frames.'],
  ['SC++',
    'Mean distance between the output and every real clip of the asked style and content, cut to the shorter ' +
    'and unaligned, in the same units.'],
  ['bone length error', 'Largest change of the length of any bone.'],
  ['step', 'Processor time of one step of one character on one core.'],
];
const definitions = () => [make('dl', { class: 'definitions' },
  ...[...MEASURES.map((measure) => [measure.label, measure.meaning]), ...DEFINITIONS]
    .flatMap(([term, meaning]) => [make('dt', {}, term), make('dd', {}, meaning)]))];

const SECTIONS = [
  ['judged', 'Training and test data',
    'All figures are measured on held-out takes, with the same code for every system. Accuracies count only ' +
    'if the classifiers recognise real held-out takes well enough.',
    evaluated],
  ['overall', 'Overall',
    'Means over styles and contents that the systems were trained on. The best system of each column is in ' +
    'bold, with a dot.',
    overall],
  ['content', 'By content',
    'Means over the styles; the best system of each row is in bold, with a dot.',
    () => byName('content', report.contents, report.real_by_content, report.input_by_content, 'seen_by_content')],
  ['style', 'By style',
    'Means over the contents; the best system of each row is in bold, with a dot.',
    () => byName('style', report.styles, report.real_by_style, null, 'seen_by_style')],
  ['performers', 'Judges of performers',
    "Each performer's judge knows this performer's training takes alone, and tells whole clips of real " +
    "held-out takes and of restyled neutral motion among the performer's styles. What it recognises of real " +
    'takes is as much as there is to recognise.',
    performers],
  ['strength', 'Strength',
    'The effect of strength: 0 is the input, 1 the style as captured, above 1 exaggeration.',
    strength],
  ['mixes', 'Mixes',
    'Two styles at half strength each.',
    mixes],
  ['unseen', 'Contents left out of training',
    'Their styled takes were left out of training. For comparison: the same contents with them in training, ' +
    'real takes classified by classifiers that were not trained on these contents, and the mean posture of ' +
    'the style.',
    unseen],
  ['foreign', 'Out-of-distribution motion',
    'Clips from other data sets and other actions, each in every style at strength 1. There is no ground ' +
    'truth: the question is whether the motion stays intact.',
    foreign],
  ['disturbances', 'Disturbances',
    'Pose error when only the input windows of a system are disturbed.',
    disturbances],
  ['arrival', 'What arrives of a style',
    'Walks restyled at strength 1: the share of the change between neutral and styled real takes that arrives, ' +
    'for each movement that differs visibly, and for what left and right do differently. 1 is as captured.',
    arrival],
  ['foresight', 'Input prediction',
    'Mean joint error in centimetres when the input is predicted, continued at constant velocity, or held. ' +
    'Live, a style that is faster than its input needs prediction.',
    foresight],
  ['persons', 'Persons',
    'People as a classifier sees them in walks, and seeds on walks of others; styles of performers on ten persons ' +
    'each; and other motion as persons, against its input.',
    persons],
  ['strips', 'Strips',
    "The same time span in each row. The body's left is lighter.",
    () => [...document.getElementById('drawn-strips').content.children]],
  ['contacts', 'Foot contacts',
    'A bar is a foot on the ground.',
    contacts],
  ['literature', 'CC and SC++',
    'As papers after 2020 compute them on the data of Xia et al. 2015. Published: CC 8.5, SC++ 63.0 (MoST ' +
    '2024, on another split).',
    literature],
  ['cost', 'Cost',
    'Of one character on one core.',
    cost],
  ['definitions', 'Definitions',
    'Shares lie between 0 and 1. A dash stands where nothing was measured.',
    definitions],
];
document.getElementById('subtitle').textContent = `${plural(systems.length, 'system')}, ` +
  `${plural(report.styles.length, 'style')}, ${plural(report.contents.length, 'content')}.`;
for (const [id, title, introduction, show] of SECTIONS) {
  const body = show().filter(Boolean);
  if (!body.length) continue;
  document.querySelector('nav').append(make('a', { href: `#${id}` }, title), '\n');
  document.querySelector('main').append(
    make('section', { id }, make('h2', {}, title), paragraph(introduction), ...body));
}
