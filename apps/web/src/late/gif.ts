// Pictures as an animated GIF; see late.ts.

import { applyPalette, GIFEncoder, quantize } from 'gifenc';

Object.assign((window as { late?: object }).late!, { gif: { applyPalette, GIFEncoder, quantize } });
