"""How the studio feels: opening, hovering, switching and scrolling, in a real Chromium."""
