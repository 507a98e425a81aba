// Starts the page: the token of the address, what was remembered, the connection to the server, the window.
import { createRoot } from "react-dom/client";
import { App } from "./shell/App";
import { connect } from "./shell/connection";
import { bindKeys } from "./shell/keys";
import { remember } from "./shell/remember";
import { dress } from "./shell/theme";
import { takeToken } from "./shell/token";
import "./styles/tokens.css";

takeToken();
remember();
dress();
bindKeys();
connect();

const root = document.getElementById("root");
if (root) createRoot(root).render(<App />);
