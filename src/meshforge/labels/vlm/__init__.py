"""Asking a vision-language model behind any OpenAI-compatible address: a client for any question, and a labeler."""
