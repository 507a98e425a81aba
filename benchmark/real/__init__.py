"""The real track: families of real assets, labelled by hand once an asset on their surface, and tasks on them."""
