// Who runs scenes: workers with the engine. The newest request counts; a long run is ended for it, and another worker is ready.

/** A stage that takes longer is ended when somebody wants something newer, in milliseconds. */
const LONG = 250;
/** Instances that wait. */
const READY = 2;

class Runs {
  /** `listener(kind, value)` is told what becomes of the newest request. */
  constructor(listener) {
    this.listener = listener;
    this.count = 0;
    this.spare = [];
    this.wanted = null;
    this.isBusy = false;
    const code = document.getElementById("lab-worker").textContent;
    this.address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    this.module = this.unpacked(document.getElementById("lab-engine").textContent.trim());
    this.module.then(() => this.fill(), (error) => listener("broken", String(error)));
  }

  /** The engine, unpacked and compiled beside the page: it is text in the page, nothing is fetched. */
  unpacked(packed) {
    return new Promise((resolve, reject) => {
      const worker = new Worker(this.address);
      worker.onmessage = ({ data }) => (data.module ? resolve(data.module) : reject(data.broken));
      worker.onerror = ({ message }) => reject(message);
      worker.postMessage({ packed });
    });
  }

  /** One worker that runs, and others that wait. */
  fill() {
    while (this.spare.length < READY) this.spare.push(this.made());
    this.worker ??= this.spare.shift();
  }

  made() {
    const worker = new Worker(this.address);
    worker.onmessage = ({ data }) => this.hear(worker, data);
    worker.onerror = (event) => this.hear(worker, { id: this.wanted?.id, broken: event.message });
    this.module.then((module) => worker.postMessage({ module }));
    return worker;
  }

  /** Runs this as soon as it can, and forgets what was asked before. */
  ask(request) {
    this.count += 1;
    this.wanted = { ...request, id: this.count };
    this.module.then(() => this.send(), () => {});
  }

  /** The worker hears of it between two stages; where that takes too long, another one does it. */
  send() {
    if (!this.wanted || this.wanted.id === this.sent) return;
    this.fill();
    this.sent = this.wanted.id;
    this.worker.postMessage(this.wanted);
    clearTimeout(this.patience);
    if (this.isBusy) this.patience = setTimeout(() => this.again(), LONG);
  }

  /** Has another worker do what this one has not begun. */
  again() {
    this.drop();
    this.sent = null;
    this.send();
  }

  /** Ends the run at hand. */
  drop() {
    clearTimeout(this.patience);
    this.worker?.terminate();
    this.worker = null;
    this.isBusy = false;
    this.fill();
  }

  stop() {
    if (!this.wanted) return;
    this.wanted = null;
    this.drop();
    this.listener("stopped", null);
  }

  hear(worker, data) {
    if (this.worker !== worker) return;
    if (data.begun) this.isBusy = true;
    // What was not begun yet is not what this is about.
    if (!this.wanted || data.id !== this.wanted.id) return;
    if (data.begun) {
      clearTimeout(this.patience);
      this.listener("began", this.wanted);
    }
    if (data.progress !== undefined) this.listener("progress", data.progress);
    if (data.message) this.listener(data.message.kind, data.message);
    if (data.broken) {
      this.drop();
      this.listener("broken", data.broken);
    }
    if (data.done) {
      this.isBusy = false;
      this.listener("done", data.id);
    }
  }
}
