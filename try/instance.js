"use strict";
/* The module of bytes `wasm`. Clocks and generators of its dependencies, which no answer asks, are refused if one does. */
async function instance(wasm) {
  const module = await WebAssembly.compile(wasm);
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (imports[from] ??= {})[name] = () => { throw new Error(`${name} of ${from} is not there`); };
  }
  return (await WebAssembly.instantiate(module, imports)).exports;
}
