// The model that takes styles off; see late.ts.

import packed from 'virtual:panache-file/remover';

Object.assign((window as { late?: object }).late!, { remover: { packed } });
