import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { basename } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { build, defineConfig, type Plugin } from 'vite';

const root = fileURLToPath(new URL('../..', import.meta.url));
const files = {
  wasm: process.env.PANACHE_WASM ?? `${root}build/wasm/panache.wasm`,
  model: `${root}models/panache-int8.safetensors`,
  walker: `${root}models/walker.safetensors`,
  remover: `${root}models/remover-int8.safetensors`,
  neutral: `${root}models/neutral.safetensors`,
};

// Libraries that the page loads when it first needs them: see src/late.ts.
const late = {
  gif: "export { applyPalette, GIFEncoder, quantize } from 'gifenc';",
  zip: "export { zipSync } from 'fflate';",
};

// A page opened from disk may not fetch anything: there, a file is a script, gzip in base64.
const packedScript = (name: string, bytes: Uint8Array) =>
  `packed_${name}='${gzipSync(bytes, { level: 9 }).toString('base64')}';`;
// The styles of the remover, which itself is loaded later.
function listRemovable() {
  const bytes = readFileSync(files.remover);
  const header = JSON.parse(bytes.toString('utf8', 8, 8 + Number(bytes.readBigUInt64LE())));
  const [names, groups] = ['styles', 'style_groups'].map(
    (key) => String(header.__metadata__[key]).split('\n'));
  return `export default ${JSON.stringify(
    names.filter(Boolean).map((style, i) => ({ name: style, group: groups[i] })))};`;
}
// import removable from 'virtual:panache-removable'
function virtualModules(): Plugin {
  const prefix = 'virtual:panache-';
  return {
    name: 'panache-modules',
    resolveId: (id) => (id.startsWith(prefix) ? `\0${id}` : null),
    load(id) {
      const [kind, name] = id.replace(`\0${prefix}`, '').split('/');
      if (kind === 'late') return late[name as keyof typeof late];
      if (kind === 'files') {
        const list = Object.entries(files).map(([late, path]) =>
          [late, { file: basename(path), size: statSync(path).size }]);
        return `export default ${JSON.stringify(Object.fromEntries(list))};`;
      }
      return kind === 'removable' ? listRemovable() : null;
    },
  };
}

// Loading modules needs a server, which a page opened from disk lacks: use one plain script.
function plainScript(): Plugin {
  return {
    name: 'panache-plain-script',
    enforce: 'post',
    transformIndexHtml: (html) => html.replace('type="module" crossorigin', 'defer')
      .replaceAll(' crossorigin', ''),
  };
}

function lateScripts(): Plugin {
  return {
    name: 'panache-late-scripts',
    apply: 'build',
    async generateBundle() {
      for (const [name, path] of Object.entries(files)) {
        const source = readFileSync(path);
        this.emitFile({ type: 'asset', fileName: `assets/${basename(path)}`, source });
        this.emitFile(
          { type: 'asset', fileName: `assets/${name}.js`, source: packedScript(name, source) });
      }
      for (const name of Object.keys(late)) {
        const [made] = [await build({ configFile: false, logLevel: 'warn',
          plugins: [virtualModules()], build: {
          write: false, target: 'es2022', modulePreload: false,
          rollupOptions: { input: `virtual:panache-late/${name}`,
            preserveEntrySignatures: 'strict', output: { format: 'iife', name: `late_${name}` } },
        } })].flat();
        if (!('output' in made)) throw new Error('nothing was built');
        this.emitFile({ type: 'asset', fileName: `assets/${name}.js`, source: made.output[0].code });
      }
    },
  };
}

// The bundled libraries' licences require their texts to be included.
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

// FILE.br next to each FILE that a server sends: `panache view` and web servers that know them
// (brotli_static) send these as they are.
function compressed(): Plugin {
  return {
    name: 'panache-compressed',
    apply: 'build',
    writeBundle({ dir }, bundle) {
      for (const name of Object.keys(bundle)) {
        if (name.replace(/^assets\/|\.js$/g, '') in files) continue;
        const file = `${dir}/${name}`, bytes = readFileSync(file);
        writeFileSync(`${file}.br`, brotliCompressSync(bytes,
          { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }));
      }
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [virtualModules(), lateScripts(), licences(), plainScript(), compressed()],
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
