// Who runs scenes: workers with the engine. The newest request counts; a long run is ended for it, and another worker is ready.

/** A run that takes longer is ended when somebody wants something newer, in milliseconds. */
const LONG = 250;
/** So long after the motion a worker listens, in milliseconds: a little less than it rests. */
const RESTS = 100;
/** Instances that wait. */
const READY = 2;

class Runs {
  /** `listener(kind, value)` is told what becomes of the newest request. */
  constructor(listener) {
    this.listener = listener;
    this.count = 0;
    this.spare = [];
    this.busy = null;
    this.waiting = null;
    const code = document.getElementById("lab-worker").textContent;
    this.address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    this.module = this.unpacked(document.getElementById("lab-engine").textContent.trim());
    this.module.then(() => this.fill(), (error) => listener("broken", String(error)));
  }

  /** The engine, unpacked and compiled beside the page: it is base64 in the page, nothing is fetched. */
  unpacked(packed) {
    return new Promise((resolve, reject) => {
      const worker = new Worker(this.address);
      worker.onmessage = ({ data }) => (data.module ? resolve(data.module) : reject(data.broken));
      worker.onerror = ({ message }) => reject(message);
      worker.postMessage({ packed });
    });
  }

  fill() {
    while (this.spare.length < READY) this.spare.push(this.worker());
  }

  worker() {
    const worker = new Worker(this.address);
    worker.onmessage = ({ data }) => this.hear(worker, data);
    worker.onerror = (event) => this.hear(worker, { broken: event.message });
    this.module.then((module) => worker.postMessage({ module }));
    return worker;
  }

  /** Runs this as soon as it can, and forgets what was asked before. */
  ask(request) {
    this.count += 1;
    this.waiting = { ...request, id: this.count };
    this.module.then(() => this.start());
  }

  start() {
    if (!this.waiting) return;
    if (this.busy) {
      // What is still to come of the report is forgotten by the worker itself: it stays, and so does what it has compiled.
      if (this.busy.rests) return this.send(this.busy.worker);
      const taken = performance.now() - this.busy.since;
      if (taken < LONG) {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.start(), LONG - taken);
        return;
      }
      this.drop();
    }
    this.fill();
    this.send(this.spare.shift());
  }

  send(worker) {
    clearTimeout(this.resting);
    const request = this.waiting;
    this.waiting = null;
    this.busy = { worker, id: request.id, since: performance.now() };
    worker.postMessage(request);
    this.listener("began", request);
  }

  /** Ends the run at hand. */
  drop() {
    clearTimeout(this.timer);
    clearTimeout(this.resting);
    this.busy?.worker.terminate();
    this.busy = null;
    this.fill();
  }

  stop() {
    this.waiting = null;
    if (!this.busy) return;
    this.drop();
    this.listener("stopped", null);
  }

  hear(worker, data) {
    if (this.busy?.worker !== worker) return;
    if (data.id !== undefined && data.id !== this.busy.id) return;
    if (data.progress !== undefined) this.listener("progress", data.progress);
    if (data.message) this.listener(data.message.kind, data.message);
    if (data.message?.kind === "motion") {
      this.busy.rests = true;
      // Once it writes the report it is busy again.
      this.resting = setTimeout(() => this.busy && Object.assign(this.busy, { rests: false, since: performance.now() }), RESTS);
      if (this.waiting) return this.start();
    }
    if (data.broken) {
      this.drop();
      this.listener("broken", data.broken);
    }
    if (data.done) {
      clearTimeout(this.resting);
      this.spare.unshift(worker);
      this.busy = null;
      this.listener("done", data.id);
    }
    if (!this.busy && this.waiting) this.start();
  }
}
