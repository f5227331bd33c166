// Files in one zip; see late.ts.

import { zipSync } from 'fflate';

const zip = { zipFiles: (files: Record<string, Uint8Array>) => zipSync(files) };
Object.assign((window as { late?: object }).late!, { zip });
