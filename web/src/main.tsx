// Starts the page: the token of the address, what was remembered, the connection to the server, the window.
import { connect } from "./shell/connection";
import { remember } from "./shell/remember";
import { dress } from "./shell/theme";
import { takeToken } from "./shell/token";
import "./styles/tokens.css";

takeToken();
remember();
dress();
connect();

const root = document.getElementById("root");
if (root) void import("./page").then((page) => page.open(root));
