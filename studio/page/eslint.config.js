import tseslint from "typescript-eslint";

export default tseslint.config({ ignores: ["node_modules", "test-results"] }, ...tseslint.configs.strict, {
  rules: {
    "@typescript-eslint/consistent-type-imports": "error",
    "@typescript-eslint/no-non-null-assertion": "off",
    eqeqeq: "error",
    "no-eval": "error",
    "no-implied-eval": "error",
    "no-restricted-properties": [
      "error",
      { property: "innerHTML", message: "text from files must never become markup" },
      { property: "outerHTML", message: "text from files must never become markup" },
      { property: "insertAdjacentHTML", message: "text from files must never become markup" },
    ],
  },
});
