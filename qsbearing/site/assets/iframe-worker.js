/* A page opened as a file may start no worker. In its place: a frame that runs the same script, with the same messages. */
if (location.protocol === "file:")
  window.Worker = class extends EventTarget {
    #waiting = []; #frame = document.createElement("iframe"); #inner = null;
    constructor(url) {
      super();
      this.#frame.hidden = true;
      this.#frame.title = "search";
      document.body.append(this.#frame);
      const inner = this.#frame.contentWindow, page = this.#frame.contentDocument;
      page.open();
      page.write("<!doctype html><title>search</title><body></body>");
      page.close();
      // What a worker has of its own: messages to its owner, and scripts that it loads one after another.
      inner.IFrameWorker = window.Worker;  // by which the theme's script knows where it is
      inner.postMessage = data => setTimeout(() => this.#heard(data));
      inner.importScripts = (...urls) => urls.reduce((before, each) => before.then(() => this.#load(page, each)), Promise.resolve());
      this.#load(page, url).then(() => { this.#inner = inner; this.#waiting.splice(0).forEach(each => this.postMessage(each)); });
    }
    #load(page, url) {
      return new Promise((done, failed) => {
        const script = page.createElement("script");
        script.src = new URL(url, location.href);
        script.onload = done;
        script.onerror = failed;
        page.body.append(script);
      });
    }
    #heard(data) {
      const event = new MessageEvent("message", { data });
      this.dispatchEvent(event);
      this.onmessage?.(event);
    }
    postMessage(data) {
      if (!this.#inner) { this.#waiting.push(data); return; }
      const event = new MessageEvent("message", { data });
      this.#inner.dispatchEvent(event);
      this.#inner.onmessage?.(event);
    }
    terminate() { this.#frame.remove(); }
  };
