// A script of its own, which comes when it is first needed: see archive.ts.

import { zipSync } from 'fflate';

Object.assign(window, { zipFiles: (files: Record<string, Uint8Array>) => zipSync(files) });
