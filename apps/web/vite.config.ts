import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build, defineConfig, type Plugin } from 'vite';

const root = fileURLToPath(new URL('../..', import.meta.url));
const files = {
  wasm: process.env.PANACHE_WASM ?? `${root}build/wasm/panache.wasm`,
  model: `${root}models/panache-int8.safetensors`,
  walker: `${root}models/walker.safetensors`,
  remover: `${root}models/remover-int8.safetensors`,
  neutral: `${root}models/neutral.safetensors`,
};

// import wasm from 'virtual:panache-file/wasm': what the page would have to fetch, packed, as
// base64, inside of the script. A page opened from a disk may fetch nothing.
function embedFiles(): Plugin {
  const prefix = 'virtual:panache-file/';
  return {
    name: 'panache-files',
    resolveId: (id) => (id.startsWith(prefix) ? `\0${id}` : null),
    load(id) {
      if (!id.startsWith(`\0${prefix}`)) return null;
      const path = files[id.slice(prefix.length + 1) as keyof typeof files];
      return `export default '${gzipSync(readFileSync(path), { level: 9 }).toString('base64')}';`;
    },
  };
}

// import removable from 'virtual:panache-removable': the styles of the remover, which comes late.
function listRemovable(): Plugin {
  const name = 'virtual:panache-removable';
  return {
    name: 'panache-removable',
    resolveId: (id) => (id === name ? `\0${name}` : null),
    load(id) {
      if (id !== `\0${name}`) return null;
      const bytes = readFileSync(files.remover);
      const header = JSON.parse(bytes.toString('utf8', 8, 8 + Number(bytes.readBigUInt64LE())));
      const [names, groups] = ['styles', 'style_groups'].map(
        (key) => String(header.__metadata__[key]).split('\n'));
      return `export default ${JSON.stringify(
        names.filter(Boolean).map((style, i) => ({ name: style, group: groups[i] })))};`;
    },
  };
}

// Modules are fetched as from a server, which a page opened from a disk has not: one plain script.
function plainScript(): Plugin {
  return {
    name: 'panache-plain-script',
    enforce: 'post',
    transformIndexHtml: (html) => html.replace('type="module" crossorigin', 'defer')
      .replaceAll(' crossorigin', ''),
  };
}

// Scripts that the page loads when it first needs them, each by itself: src/late.ts.
function lateScripts(): Plugin {
  return {
    name: 'panache-late-scripts',
    apply: 'build',
    async generateBundle() {
      for (const name of ['gif', 'neutral', 'remover', 'zip']) {
        const input = fileURLToPath(new URL(`src/late/${name}.ts`, import.meta.url));
        const [made] = [await build({ configFile: false, logLevel: 'warn',
          plugins: [embedFiles()], build: {
          write: false, target: 'es2022', modulePreload: false,
          rollupOptions: { input, output: { format: 'iife' } },
        } })].flat();
        if (!('output' in made)) throw new Error('nothing was built');
        this.emitFile({ type: 'asset', fileName: `assets/${name}.js`, source: made.output[0].code });
      }
    },
  };
}

// The licences of what is in the page want their texts to go with it.
function licences(): Plugin {
  return {
    name: 'panache-licences',
    apply: 'build',
    generateBundle() {
      const text = [['fflate', 'LICENSE'], ['gifenc', 'LICENSE.md'], ['three', 'LICENSE']]
        .map(([name, file]) => `${name}\n\n${readFileSync(`node_modules/${name}/${file}`, 'utf8')}`);
      this.emitFile({ type: 'asset', fileName: 'licences.txt', source: text.join('\n\n') });
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [embedFiles(), listRemovable(), lateScripts(), licences(), plainScript()],
  build: {
    outDir: `${root}build/web`,
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { output: { format: 'iife' } },
  },
  test: { include: ['test/**/*.test.{ts,js}'] },
} as Parameters<typeof defineConfig>[0]);
