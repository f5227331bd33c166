// Files that `panache view` serves with the page; the page's address names them.

import { PanacheError } from '../package/index.js';

export async function served(kind: 'open' | 'model'): Promise<File | null> {
  const name = new URLSearchParams(location.search).get(kind);
  if (!name) return null;
  const answer = await fetch(`${kind}/${encodeURIComponent(name)}`);
  if (!answer.ok) throw new PanacheError(`${name}: the server has no such file`);
  return new File([await answer.blob()], name);
}
