// Keeps the page for when there is no network: every file of one build together, so that page and engine always fit.
// VERSION and FILES are filled in when the page is built.
const NAME = `flexframe-studio-${"VERSION"}`;
const FILES = ["FILES"];

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(FILES)));
});

self.addEventListener("activate", (event) => {
  const former = (name) => name.startsWith("flexframe-studio-") && name !== NAME;
  const clean = async () => {
    for (const name of await caches.keys()) if (former(name)) await caches.delete(name);
    await self.clients.claim();
  };
  event.waitUntil(clean());
});

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== self.location.origin) return;
  const answer = async () => {
    const cache = await caches.open(NAME);
    const path = event.request.mode === "navigate" ? "./" : event.request;
    return (await cache.match(path, { ignoreSearch: true })) ?? fetch(event.request);
  };
  event.respondWith(answer());
});
