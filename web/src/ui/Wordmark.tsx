// The name, with its sign: a hull in three facets.

export function Wordmark({ large = false }: { large?: boolean }) {
  const size = large ? 44 : 20;
  return (
    <span style={{ display: "inline-flex", alignItems: "center", gap: large ? 14 : 8, color: "var(--text)" }}>
      <svg width={size} height={size} viewBox="0 0 32 32" aria-hidden>
        <path d="M16 3 29 11 16 17 3 11Z" fill="var(--accent)" opacity="0.55" />
        <path d="M3 11 16 17V29.5L5.5 22.5Z" fill="var(--accent)" />
        <path d="M29 11 16 17V29.5L26.5 22.5Z" fill="var(--accent)" opacity="0.78" />
      </svg>
      <span style={{ fontSize: large ? 28 : 14, fontWeight: 650, letterSpacing: "-0.01em" }}>MeshForge</span>
    </span>
  );
}
