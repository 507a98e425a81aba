import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// While the page is developed, a studio that runs at this address answers for it.
const studio = `127.0.0.1:${process.env.STUDIO_PORT ?? "8765"}`;

// The built page goes into the Python package, which serves it; addresses are relative to where it is served.
export default defineConfig({
  base: "./",
  plugins: [react()],
  build: {
    outDir: "../src/meshforge/studio/static",
    emptyOutDir: true,
    chunkSizeWarningLimit: 2000,
  },
  server: { proxy: { "/api": `http://${studio}`, "/ws": { target: `ws://${studio}`, ws: true } } },
});
