"""USD: stages as text, crate or package, with the physics schemas of OpenUSD."""
