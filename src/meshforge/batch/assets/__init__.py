"""Which assets a batch has, with what is known of each before it is read."""
