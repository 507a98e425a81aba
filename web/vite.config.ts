import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// The built page goes into the Python package, which serves it; addresses are relative to where it is served.
export default defineConfig({
  base: "./",
  plugins: [react()],
  build: {
    outDir: "../src/meshforge/studio/static",
    emptyOutDir: true,
    chunkSizeWarningLimit: 2000,
  },
  server: { proxy: { "/api": "http://127.0.0.1:8765", "/ws": { target: "ws://127.0.0.1:8765", ws: true } } },
});
