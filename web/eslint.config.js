import hooks from "eslint-plugin-react-hooks";
import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["src/wire.ts"] },
  ...tseslint.configs.strict,
  { rules: { "@typescript-eslint/no-unused-vars": ["error", { ignoreRestSiblings: true }] } },
  {
    // what the page knows and can do is apart from how it looks
    files: ["src/server/**", "src/store/**", "src/commands/**"],
    rules: {
      "no-restricted-imports": [
        "error",
        { patterns: ["three", "three/*", "react-dom*", "**/{family,hulls,panels,pictures,shell,steps,text,ui,viewport}/**"] },
      ],
    },
  },
  { plugins: { "react-hooks": hooks }, rules: { "react-hooks/rules-of-hooks": "error", "react-hooks/exhaustive-deps": "error" } },
);
