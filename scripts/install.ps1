# Installs the command chamfer for Windows: takes the newest release and puts the program into
# %LOCALAPPDATA%\chamfer, which it adds to the user's Path. It asks for no rights and changes nothing else.
# In a block of its own, so that what is set here does not stay in the window that it is run from.
& {
    $ErrorActionPreference = "Stop"
    # Windows PowerShell takes longer to draw the bar of a download than the download takes.
    $ProgressPreference = "SilentlyContinue"
    $address = if ($env:CHAMFER_ADDRESS) { $env:CHAMFER_ADDRESS } else { "@ADDRESS@" }
    $bin = if ($env:CHAMFER_BIN) { $env:CHAMFER_BIN } else { Join-Path $env:LOCALAPPDATA "chamfer" }
    # A part of Windows since version 10. Another tar on the Path may take C: for the name of a computer.
    $tar = Join-Path $env:SystemRoot "System32\tar.exe"
    if (-not (Test-Path $tar)) { throw "chamfer was not installed: it needs $tar, which Windows has since version 10" }

    $release = "$address/releases/latest/download/chamfer-windows.tar.gz"
    $archive = Join-Path ([IO.Path]::GetTempPath()) "chamfer-windows.tar.gz"
    try { Invoke-WebRequest -UseBasicParsing $release -OutFile $archive }
    catch { throw "chamfer was not installed: $release cannot be had: $_" }
    New-Item -ItemType Directory -Force $bin | Out-Null
    & $tar -C $bin -xzf $archive
    if ($LASTEXITCODE -ne 0) { throw "chamfer was not installed: $archive cannot be unpacked into $bin; is chamfer running?" }
    Remove-Item $archive

    $path = [Environment]::GetEnvironmentVariable("Path", "User")
    if (($path -split ";") -notcontains $bin) {
        [Environment]::SetEnvironmentVariable("Path", (@($path, $bin) -ne "") -join ";", "User")
    }
    Write-Output "installed $bin\chamfer.exe; in a new window, try: chamfer demo"
}
