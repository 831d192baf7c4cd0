// Keeps the page for when there is no network: every file of one build together, so that page and engine always fit.
// VERSION and FILES, each file with the SHA-256 of its bytes, are filled in when the page is built.
// Caches belong to the origin: another studio beside this one has its own.
const OWN = `flexframe-studio ${self.registration.scope} `;
const NAME = `${OWN}${"VERSION"}`;
const FILES = { FILES: "" };

/** A file of this build. The browser's own cache, and a host that is being filled, may have one of another. */
async function fetched(file, sha256) {
  const answer = await fetch(new Request(file, { cache: "no-cache" }));
  const bytes = await answer.clone().arrayBuffer();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const found = Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
  if (!answer.ok || found !== sha256) throw new Error(`${file} is not the file of this version`);
  return answer;
}

/** All files or none: where one does not come, the version of before goes on. */
async function install() {
  const files = Object.entries(FILES);
  const answers = await Promise.all(files.map(([file, sha256]) => fetched(file, sha256)));
  const cache = await caches.open(NAME);
  await Promise.all(files.map(([file], at) => cache.put(file, answers[at])));
}

self.addEventListener("install", (event) => event.waitUntil(install()));

self.addEventListener("activate", (event) => {
  const former = (name) => name.startsWith(OWN) && name !== NAME;
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
