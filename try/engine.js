"use strict";
/* The engine as WebAssembly, in a worker of its own so that the page stays awake; asked as the server is. */
(() => {
  const work = async (packed) => {
    const unpacked = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
    const exports = await instance(await unpacked.arrayBuffer());
    onmessage = ({ data: [id, question] }) => {
      const asked = new TextEncoder().encode(question);
      const at = exports.room(asked.length);
      new Uint8Array(exports.memory.buffer, at, asked.length).set(asked);
      const bytes = exports.answer();
      postMessage([id, new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.answered(), bytes))]);
    };
    postMessage([0, ""]);
  };
  const text = (id) => document.getElementById(id).textContent;
  const packed = Uint8Array.from(atob(text("engine")), (c) => c.charCodeAt(0));
  const worker = new Worker(URL.createObjectURL(new Blob([text("instance"), `onmessage = ({ data }) => (${work})(data);`], { type: "text/javascript" })));
  worker.postMessage(packed);
  const waiting = new Map();
  let last = 0;
  const ready = new Promise((done, failed) => {
    waiting.set(0, done);
    worker.onerror = (event) => {
      const why = { message: `the engine stopped: ${event.message}. Load the page again` };
      failed(why);
      for (const [, , broken] of waiting.values()) broken?.(why);
    };
  });
  worker.onmessage = ({ data: [id, answer] }) => {
    const found = waiting.get(id);
    waiting.delete(id);
    if (id === 0) return found();
    const value = JSON.parse(answer);
    "found" in value ? found[1](value.found) : found[2](value.refused);
  };
  window.sprag = {
    async ask(ask, question) {
      if (ask === "open") return JSON.parse(text("first"));
      await ready;
      return new Promise((...ends) => {
        waiting.set(++last, [null, ...ends]);
        worker.postMessage([last, JSON.stringify({ ask, question })]);
      });
    },
  };
})();
