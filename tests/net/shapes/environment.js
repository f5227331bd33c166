// Emscripten's programs have an environment of their own; this one gets the machine's.
Module['preRun'] = () => Object.assign(ENV, process.env);
