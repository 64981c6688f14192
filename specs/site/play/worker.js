// The engine in a thread of its own. It stands behind the text of the engine, in one Blob. The first message brings the
// compiled module; each other one is a call, answered by its number.
let ready;
onmessage = ({ data }) => {
  if (data.module) {
    ready = stormproofEngine({ wasmBinary: data.module });
    return;
  }
  ready.then((engine) => {
    const text = (name, types, args) => JSON.parse(engine.ccall(name, "string", types, args));
    const calls = {
      open: (yaml) => text("page_open", ["string"], [yaml]),
      sample: (seed) => text("page_sample", ["number"], [seed]),
      moment: (event, who) => text("page_moment", ["number", "number"], [event, who]),
      step: (event, who, on) => engine.ccall("page_step", "number", ["number", "number", "number"], [event, who, on]),
      record: (pictures) => {
        const run = text("page_record", ["number"], [pictures]);
        const at = engine.ccall("page_known", "number", [], []);
        run.known = engine.HEAPU8.slice(at, at + engine.ccall("page_known_bytes", "number", [], []));
        return run;
      },
    };
    postMessage({ id: data.id, answer: calls[data.call](...data.args) });
  }).catch((failure) => postMessage({ id: data.id, failure: String(failure.message || failure) }));
};
