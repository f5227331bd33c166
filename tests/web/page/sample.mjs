// Serves samples/three_vrm with the package that ./run web makes.
import { cp, mkdir, mkdtemp, readFile, rm, symlink } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const types = { '.html': 'text/html', '.mjs': 'text/javascript', '.js': 'text/javascript' };

/** Its address, and close(). */
export async function serveSample() {
  const folder = await mkdtemp(join(tmpdir(), 'panache-vrm-'));
  await cp(join(root, 'samples/three_vrm'), folder, { recursive: true });
  await mkdir(join(folder, 'node_modules'), { recursive: true });
  await symlink(join(root, 'build/npm'), join(folder, 'node_modules/panache'));
  for (const name of ['three', '@pixiv']) {
    await symlink(join(root, 'tests/web/node_modules', name), join(folder, 'node_modules', name));
  }
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname.replace(/\/$/, '/index.html');
    try {
      const body = await readFile(join(folder, path));
      response.setHeader('Content-Type', types[extname(path)] ?? 'application/octet-stream');
      response.end(body);
    } catch {
      response.statusCode = 404;
      response.end();
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const close = async () => {
    server.close();
    await rm(folder, { recursive: true });
  };
  return { address: `http://127.0.0.1:${server.address().port}/`, close };
}
