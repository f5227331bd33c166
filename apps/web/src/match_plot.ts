// Plots the time alignment of two motions: the matching instants, and a few pairs of poses to check
// it by.

import type { LearnReport } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { colour } from './dom';
import { paintFigure } from './figures';

const kFigures = 58, kTracks = 58;  // CSS pixels: each row of figures, both time lines.
const kGood = 0.35, kFair = 0.6;    // Distances, as in the report's verdict.
const kLinkEvery = 3;               // Instants.

export const kMatchPlotHeight = 2 * kFigures + kTracks;

/** Styled above, neutral below, on the same time scale. */
export function drawMatch(canvas: HTMLCanvasElement, plot: LearnReport['plot']) {
  const context = canvas.getContext('2d')!;
  const width = canvas.clientWidth;
  const ratio = Math.min(2, Math.max(1, devicePixelRatio));
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(kMatchPlotHeight * ratio);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const longest = Math.max(plot.styledSeconds, plot.neutralSeconds);
  const across = (seconds: number) => 4 + ((width - 8) * seconds) / longest;
  const top = kFigures + 6, bottom = kFigures + kTracks - 6;
  plot.instants.forEach(([styled, neutral, distance], i) => {
    if (i % kLinkEvery !== 0) return;
    context.strokeStyle = colour(
      distance < kGood ? 'accent' : distance <= kFair ? 'soft' : 'bad');
    context.globalAlpha = 0.7;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(across(styled), top);
    context.lineTo(across(neutral), bottom);
    context.stroke();
  });
  context.globalAlpha = 1;
  context.fillStyle = colour('ink');
  context.fillRect(across(0), top - 2, across(plot.styledSeconds) - across(0), 2);
  context.fillRect(across(0), bottom, across(plot.neutralSeconds) - across(0), 2);

  const column = width / Math.max(1, plot.poses.length);
  plot.poses.forEach((pose, i) => {
    for (const [numbers, y, ink] of [[pose.styled, 0, 'accent'],
      [pose.neutral, kFigures + kTracks, 'soft']] as const) {
      context.save();
      context.translate(column * i, y);
      paintFigure(context, column, kFigures, (joint) => {
        const k = 3 * humanJoints.indexOf(joint);
        return [numbers[k], numbers[k + 1], numbers[k + 2]];
      }, ink);
      context.restore();
    }
  });
}
