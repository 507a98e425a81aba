// Has the browser save a file of the server.

/** The address says that it is a download, so the page stays as it is. */
export function saveFrom(address: string): void {
  const link = document.createElement("a");
  link.href = address;
  link.download = ""; // the server names it
  document.body.append(link);
  link.click();
  link.remove();
}
