"""What an asset must do after its edit, as expressions on extractors: `supports(Is(top))`."""
