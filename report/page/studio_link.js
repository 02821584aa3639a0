// The way to the server: requests go out one at a time, and of what comes back only what answers the newest one is passed on.

const patience = 300; // ms for a first picture, while newer values wait: then its search is ended
const again = 1500; // ms between two attempts to reach a server

function randomName() {
  return [...crypto.getRandomValues(new Uint8Array(12))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

export class Link {
  // `onEvent(event)`: a line of the newest answer; `onState(state)`: "open", "lost" or "ended" (another run of the server, or too many
  // windows: `onState` is told why).
  constructor(token, onEvent, onState) {
    Object.assign(this, {token, onEvent, onState});
    this.number = 0;
    this.waiting = null; // a request that is to be sent
    this.pending = null; // when the one was sent whose first picture is not there yet
    this.last = null;
    this.dropped = 0; // lines of older answers
    this.connect();
  }

  connect() {
    this.client = randomName();
    this.stream = new EventSource(`/events?token=${this.token}&client=${this.client}`);
    this.stream.onopen = () => {
      this.open = true;
      this.onState("open");
      if (!this.waiting && this.last) this.waiting = this.last;
      this.pending = null;
      this.send();
    };
    this.stream.onmessage = ({data}) => this.receive(JSON.parse(data));
    this.stream.onerror = () => {
      this.open = false;
      this.stream.close();
      this.explain();
    };
  }

  // An event stream does not say why it was refused.
  async explain() {
    try {
      const response = await fetch(`/ask?token=${this.token}&client=0`);
      this.onState(response.status === 403 ? "ended" : "lost");
    } catch {
      this.onState("lost");
    }
    setTimeout(() => this.connect(), again);
  }

  // `request` without its number. Newer values take the place of those that wait.
  ask(request) {
    this.waiting = request;
    this.send();
  }

  send() {
    if (!this.open || !this.waiting) return;
    const rest = this.pending === null ? 0 : this.pending + patience - performance.now();
    if (rest > 0) {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.send(), rest);
      return;
    }
    const request = {number: ++this.number, ...this.waiting};
    this.last = this.waiting;
    this.waiting = null;
    this.pending = performance.now();
    this.sent = this.pending;
    this.onEvent({event: "sent", number: this.number, request});
    fetch(`/ask?token=${this.token}&client=${this.client}&number=${this.number}`, {
      method: "POST",
      body: JSON.stringify(request),
    }).catch(() => {});
  }

  receive(event) {
    if (event.event === "bad") event.number = this.number;
    if (event.number !== this.number) {
      ++this.dropped;
      return;
    }
    this.onEvent(event);
    if (["picture", "error", "bad", "done"].includes(event.event)) {
      this.pending = null;
      this.send();
    }
  }
}
