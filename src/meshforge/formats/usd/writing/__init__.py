"""From an edited asset back into its stage: prims taken out, switched off, parted and made."""
