import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// While the page is developed, a studio that runs at this address answers for it.
const studio = `127.0.0.1:${process.env.STUDIO_PORT ?? "8765"}`;

// The studio talks to pages of its own origin only, so requests come to it as if from there.
const server = { target: `http://${studio}`, changeOrigin: true, headers: { origin: `http://${studio}` } };

// The built page goes into the Python package, which serves it; addresses are relative to where it is served.
export default defineConfig({
  base: "./",
  plugins: [react()],
  css: { transformer: "lightningcss" },
  build: {
    outDir: "../src/meshforge/studio/static",
    emptyOutDir: true,
    chunkSizeWarningLimit: 2000,
  },
  server: { proxy: { "/api": server, "/download": server, "/ws": { ...server, ws: true } } },
});
