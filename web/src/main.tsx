// Starts the page: the token of the address, what was remembered, the connection to the server, the window.
import { connect, takeToken } from "./shell/connection";
import { followTheme, keepPreferences } from "./shell/preferences";
import "./styles/tokens.css";

takeToken();
keepPreferences();
followTheme();
connect();

const root = document.getElementById("root");
if (root) void import("./page").then((page) => page.open(root));
