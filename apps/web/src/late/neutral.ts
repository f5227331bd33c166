// The neutral motion of many people, for styles of one clip; see late.ts.

import packed from 'virtual:panache-file/neutral';

Object.assign((window as { late?: object }).late!, { neutral: { packed } });
