// A page that is served live: it comes anew when there is another version, seen from where it was.
// (The last of the scripts; a page that has only words has it alone.)
const version = document.body.dataset.version;
const KEPT = "handey view";
if (version) {
  const news = document.getElementById("live"), hasView = typeof camera !== "undefined";
  const say = (words) => { news.textContent = words; news.hidden = !words; };
  addEventListener("pagehide", () => {
    if (!hasView) return;
    const scrolled = document.getElementById("told").scrollTop;
    sessionStorage.setItem(KEPT, JSON.stringify({ camera, now, shown, scrolled, title: document.title }));
  });
  if (hasView) {
    try {
      const kept = JSON.parse(sessionStorage.getItem(KEPT) || "null");
      if (kept && kept.title === document.title) {
        Object.assign(camera, kept.camera);
        Object.assign(shown, kept.shown);
        document.getElementById("told").scrollTop = kept.scrolled;
        seek(kept.now);
        show();
        fillLegend();
      }
    } catch { sessionStorage.removeItem(KEPT); }
  }
  const events = new EventSource("/changes");
  events.onmessage = (event) => {
    const state = JSON.parse(event.data);
    if (state.version !== version) { events.close(); location.reload(); } else say(state.status === "planning" ? "Planning\u2026" : "");
  };
  events.onerror = () => say("The server has ended, or cannot be reached.");
}
